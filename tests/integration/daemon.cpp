#include "integration/daemon.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>

namespace isofield::integration_test {
namespace {

constexpr char kListening[] = "listening on ";
constexpr char kValidationMessage[] = "Vulkan validation:";

std::unique_ptr<Daemon> the_daemon;

class DaemonEnvironment : public testing::Environment {
 public:
  void TearDown() override { the_daemon.reset(); }
};

// GoogleTest owns the environment.
[[maybe_unused]] testing::Environment* const environment = testing::AddGlobalTestEnvironment(new DaemonEnvironment);

// Machines without the validation layer can run the tests, too, but not by default.
bool with_validation() {
  return std::getenv("ISOFIELD_TESTS_WITHOUT_VALIDATION") == nullptr;
}

}  // namespace

std::vector<std::string> daemon_command(const std::vector<std::string>& flags) {
  // tests/run lets the tests of this build run against a daemon that was built with a sanitizer.
  const char* const other = std::getenv("ISOFIELD_TESTS_DAEMON");
  std::vector<std::string> all{other != nullptr ? other : ISOFIELD_DAEMON};
  all.insert(all.end(), flags.begin(), flags.end());
  return all;
}

std::vector<std::string> Daemon::command(const std::vector<std::string>& flags, const std::string& listen) {
  // Kernels are compiled only on demand unless a test is about that, since the tests share the processor.
  std::vector<std::string> all = daemon_command({"--listen", listen, "--compile-ahead=false"});
  if (with_validation()) all.push_back("--validation");
  all.insert(all.end(), flags.begin(), flags.end());
  return all;
}

Daemon::Daemon(const std::vector<std::string>& flags, const std::string& listen)
    : process_(command(flags, listen.empty() ? "unix:" + directory_.path("socket") : listen)) {
  const std::string line = process_.wait_for_error_line(kListening);
  if (line.empty()) {
    process_.signal(SIGKILL);
    process_.wait();
    std::cerr << "isofieldd does not start:\n" << process_.errors();
    std::exit(1);
  }
  address_ = line.substr(line.find(kListening) + sizeof(kListening) - 1);
}

Daemon::~Daemon() {
  stop();
}

void Daemon::stop() {
  if (is_stopped_) return;
  process_.signal(SIGTERM);
  expect_orderly_end();
}

void Daemon::expect_orderly_end() {
  is_stopped_ = true;
  const int code = process_.wait();
  const std::string log = process_.errors();
  EXPECT_EQ(code, 0) << "isofieldd's log:\n" << log;
  EXPECT_EQ(log.find(kValidationMessage), std::string::npos) << "the validation layer has complained:\n" << log;
}

void Daemon::kill() {
  is_stopped_ = true;
  process_.signal(SIGKILL);
  process_.wait();
}

Daemon& shared_daemon() {
  if (!the_daemon) the_daemon = std::make_unique<Daemon>();
  return *the_daemon;
}

}  // namespace isofield::integration_test
