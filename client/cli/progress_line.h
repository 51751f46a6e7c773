#pragma once

#include <chrono>
#include <string>

namespace isofield {

// A line on the standard error that is written over and over; silent when that is no terminal. Gone when destroyed.
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
