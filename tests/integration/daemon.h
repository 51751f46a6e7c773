// The real isofieldd as a child process.
#pragma once

#include <string>
#include <vector>

#include "integration/process.h"
#include "integration/temporary_directory.h"

namespace isofield::integration_test {

// Serves once constructed; the tests end where it does not start. It runs under the Vulkan validation layer, and its
// end fails the test when it is not orderly or the layer has complained.
class Daemon {
 public:
  // Listens on a unix socket in a directory of its own, or on `listen` where that is stated.
  explicit Daemon(const std::vector<std::string>& flags = {}, const std::string& listen = "");
  ~Daemon();

  // For clients: with the real port where it was to choose one.
  const std::string& address() const { return address_; }
  bool is_running() { return process_.is_running(); }
  Process& process() { return process_; }
  // Asks it to stop with SIGTERM, waits, and checks how it ended; once.
  void stop();
  // The same where it has been asked already: a second signal would end it at once.
  void expect_orderly_end();
  // Ends it with SIGKILL, as a machine's failure would.
  void kill();

 private:
  static std::vector<std::string> command(const std::vector<std::string>& flags, const std::string& listen);

  TemporaryDirectory directory_;
  std::string address_;
  bool is_stopped_ = false;
  Process process_;
};

// One for all tests of the process that need no flags of their own.
Daemon& shared_daemon();

// `isofieldd` with these flags, as it stands on a command line.
std::vector<std::string> daemon_command(const std::vector<std::string>& flags);

}  // namespace isofield::integration_test
