#include "progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace isofield {

ProgressLine::ProgressLine(bool enabled) : enabled_(enabled && ::isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() {
  // These codes move the cursor to the start of the line and clear it.
  if (enabled_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::show(const std::string& stage, const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!enabled_ || (now < next_ && stage == stage_)) return;
  stage_ = stage;
  next_ = now + std::chrono::milliseconds(100);
  std::fprintf(stderr, "\r\x1b[K%s: %s", stage.c_str(), text.c_str());
  std::fflush(stderr);
}

}  // namespace isofield
