// Starts, feeds, watches and ends child processes.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace isofield::integration_test {

// Owns a child process. Its output is read all the time, so that it never waits for the test. Only one thread may use
// it.
class Process {
 public:
  // Starts the command. The standard input is a file, by default an empty one.
  explicit Process(const std::vector<std::string>& command, const std::string& input_path = "/dev/null");
  // Kills the process if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number);
  bool is_running();
  // Waits for the end. Returns the exit code, or 128 + the signal that ended the process. A process that has not ended
  // within five minutes is killed, and the test fails.
  int wait();
  // Blocks until the process has written a line with `text` to standard error, and returns the line. Returns "" if the
  // process closes the stream without such a line, or does not write it within two minutes.
  std::string wait_for_error_line(const std::string& text) { return wait_for_line(errors_, text); }
  // Does the same for standard output.
  std::string wait_for_output_line(const std::string& text) { return wait_for_line(output_, text); }
  // Return all that the process has written so far.
  std::string output() const;
  std::string errors() const;

 private:
  struct Stream {
    int descriptor = -1;
    std::string text;
    bool is_closed = false;
    std::thread reader;
  };
  void read_all(Stream& stream);
  // Waits until the process has ended, and returns false if it has not within five minutes. waitpid() must follow.
  bool ends_in_time() const;
  std::string wait_for_line(const Stream& stream, const std::string& text);

  pid_t pid_ = -1;
  int exit_code_ = -1;  // -1 until the process has been waited for
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Stream output_, errors_;
};

struct Outcome {
  int exit_code = 0;
  std::string output, errors;
};
// Runs a command to its end.
Outcome run(const std::vector<std::string>& command, const std::string& input_path = "/dev/null");

}  // namespace isofield::integration_test
