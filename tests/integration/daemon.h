// Runs the real isofieldd as a child process of the tests.
#pragma once

#include <string>
#include <vector>

#include "integration/process.h"
#include "integration/temporary_directory.h"

namespace isofield::integration_test {

// Owns the process. It serves once it is constructed; if it does not start, the tests end. It runs under the Vulkan
// validation layer. The test fails if the process does not end in an orderly way, or if the layer has complained.
class Daemon {
 public:
  // Listens at a unix socket in a directory of its own, or at `listen` if that is not empty.
  explicit Daemon(const std::vector<std::string>& flags = {}, const std::string& listen = "");
  ~Daemon();

  // Returns the address for clients, with the real port if the daemon was to choose one.
  const std::string& address() const { return address_; }
  bool is_running() { return process_.is_running(); }
  Process& process() { return process_; }
  // Asks the daemon to stop with SIGTERM, waits, and checks how it ended. Further calls do nothing.
  void stop();
  // Does the same if the daemon has been asked already, because a second signal would end it at once.
  void expect_orderly_end();
  // Ends the daemon with SIGKILL, as a machine's failure would.
  void kill();

 private:
  static std::vector<std::string> command(const std::vector<std::string>& flags, const std::string& listen);

  TemporaryDirectory directory_;
  std::string address_;
  bool is_stopped_ = false;
  Process process_;
};

// Returns the daemon of all tests of the process that need no flags of their own. The first call starts it.
Daemon& shared_daemon();

// Returns the command line that runs `isofieldd` with these flags.
std::vector<std::string> daemon_command(const std::vector<std::string>& flags);

}  // namespace isofield::integration_test
