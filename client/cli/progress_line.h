#pragma once

#include <chrono>
#include <string>

namespace isofield {

// Shows how far some long work is, in one line on the standard error that each call overwrites. It prints nothing if
// the standard error is not a terminal, and the destructor clears the line.
class ProgressLine {
 public:
  explicit ProgressLine(bool enabled);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Shows "STAGE: TEXT", at most ten times a second and whenever the stage changes.
  void show(const std::string& stage, const std::string& text);

 private:
  const bool enabled_;
  std::string stage_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace isofield
