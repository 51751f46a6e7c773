#include "integration/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

// The C library's header declares pidfd_open() without C linkage before version 2.37.
extern "C" {
#include <sys/pidfd.h>
}

namespace isofield::integration_test {
namespace {

[[noreturn]] void die(const char* what, int error) {
  std::fprintf(stderr, "%s: %s\n", what, std::strerror(error));
  std::abort();
}

int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::string& input_path) {
  int output[2], errors[2];
  if (::pipe2(output, O_CLOEXEC) != 0 || ::pipe2(errors, O_CLOEXEC) != 0) die("pipe", errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input_path.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int error = ::posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
  if (error != 0) die(arguments[0], error);
  posix_spawn_file_actions_destroy(&actions);
  ::close(output[1]);
  ::close(errors[1]);
  output_.descriptor = output[0];
  errors_.descriptor = errors[0];
  for (Stream* stream : {&output_, &errors_}) stream->reader = std::thread([this, stream] { read_all(*stream); });
}

Process::~Process() {
  if (is_running()) signal(SIGKILL);
  wait();
}

void Process::read_all(Stream& stream) {
  char block[65536];
  for (;;) {
    const ssize_t got = ::read(stream.descriptor, block, sizeof(block));
    if (got < 0 && errno == EINTR) continue;
    const std::lock_guard lock(mutex_);
    if (got > 0) stream.text.append(block, static_cast<std::size_t>(got));
    stream.is_closed = got <= 0;
    changed_.notify_all();
    if (got <= 0) break;
  }
  ::close(stream.descriptor);
}

void Process::signal(int number) {
  if (exit_code_ < 0) ::kill(pid_, number);
}

bool Process::is_running() {
  if (exit_code_ >= 0) return false;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return true;
  exit_code_ = exit_code_of(status);
  return false;
}

bool Process::ends_in_time() const {
  const int descriptor = ::pidfd_open(pid_, 0);
  if (descriptor < 0) die("pidfd_open", errno);
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  pollfd ended{descriptor, POLLIN, 0};
  int ready = 0;
  do {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(limit - std::chrono::steady_clock::now()).count();
    ready = ::poll(&ended, 1, left > 0 ? static_cast<int>(left) : 0);
  } while (ready < 0 && errno == EINTR);
  ::close(descriptor);
  return ready > 0;
}

int Process::wait() {
  if (is_running() && !ends_in_time()) {
    ADD_FAILURE() << "process " << pid_ << " has not ended within five minutes, and is killed. It wrote:\n" << errors();
    signal(SIGKILL);
  }
  int status = 0;
  while (exit_code_ < 0) {
    if (::waitpid(pid_, &status, 0) == pid_) {
      exit_code_ = exit_code_of(status);
    } else if (errno != EINTR) {
      die("waitpid", errno);
    }
  }
  {
    // A child of the process may still hold its streams open. Nothing can end the threads that read them.
    std::unique_lock lock(mutex_);
    const auto are_closed = [&] { return output_.is_closed && errors_.is_closed; };
    if (!changed_.wait_for(lock, std::chrono::minutes(2), are_closed)) {
      die("a child of an ended process holds its output open", ETIMEDOUT);
    }
  }
  for (Stream* stream : {&output_, &errors_}) {
    if (stream->reader.joinable()) stream->reader.join();
  }
  return exit_code_;
}

std::string Process::wait_for_line(const Stream& stream, const std::string& text) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  std::unique_lock lock(mutex_);
  for (;;) {
    const std::string& all = stream.text;
    if (const std::size_t at = all.find(text); at != std::string::npos) {
      const std::size_t end = all.find('\n', at);
      const std::size_t before = all.rfind('\n', at);
      const std::size_t begin = before == std::string::npos ? 0 : before + 1;
      if (end != std::string::npos) return all.substr(begin, end - begin);
    }
    if (stream.is_closed || std::chrono::steady_clock::now() >= limit) return "";
    changed_.wait_until(lock, limit);
  }
}

std::string Process::output() const {
  const std::lock_guard lock(mutex_);
  return output_.text;
}

std::string Process::errors() const {
  const std::lock_guard lock(mutex_);
  return errors_.text;
}

Outcome run(const std::vector<std::string>& command, const std::string& input_path) {
  Process process(command, input_path);
  const int code = process.wait();
  return {code, process.output(), process.errors()};
}

}  // namespace isofield::integration_test
