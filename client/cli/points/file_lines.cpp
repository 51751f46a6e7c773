#include "points/file_lines.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cstring>

namespace isofield {

// Moves `place` to the next `wanted` from begin_ on, or to end_ if the block has none. `place` is the result of the
// last search, so the bytes before it need not be searched again.
void FileLines::find_next(char wanted, std::size_t& place) const {
  place = std::max(place, begin_);
  if (place >= end_ || block_[place] == wanted) return;
  const void* const found = std::memchr(&block_[place], wanted, end_ - place);
  place = found ? static_cast<std::size_t>(static_cast<const char*>(found) - block_.data()) : end_;
}

// Returns the end of the line that begins at begin_, or nullptr if the line continues beyond the block.
const char* FileLines::find_line_end() {
  find_next('\n', next_lf_);
  find_next('\r', next_cr_);
  const std::size_t end = std::min(next_lf_, next_cr_);
  return end < end_ ? block_.data() + end : nullptr;
}

absl::StatusOr<bool> FileLines::next(absl::string_view& line, const char* expected) {
  while (true) {
    // Skips the LF of a CR LF.
    if (after_cr_ && begin_ < end_) {
      if (block_[begin_] == '\n') ++begin_;
      after_cr_ = false;
    }
    const char* const begin = block_.data() + begin_;
    const char* const end = begin_ < end_ ? find_line_end() : nullptr;
    if (end != nullptr || (at_end_ && begin_ < end_)) {
      const std::size_t length = end != nullptr ? static_cast<std::size_t>(end - begin) : end_ - begin_;
      line = absl::string_view(begin, length);
      after_cr_ = end != nullptr && *end == '\r';
      begin_ += length + (end != nullptr ? 1 : 0);
      ++line_number_;
      // A byte order mark is not a part of the text.
      if (line_number_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
      return true;
    }
    if (at_end_) return false;
    if (auto status = fill(expected); !status.ok()) return status;
  }
}

// Moves the rest of the block to its start and reads more behind it.
absl::Status FileLines::fill(const char* expected) {
  std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  next_lf_ = next_cr_ = end_;
  begin_ = 0;
  if (end_ == block_.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat(file_.name(), ":", line_number_ + 1, ": a line longer than 1 MiB; expected ", expected));
  }
  const auto got = file_.read(block_.data() + end_, block_.size() - end_);
  if (!got.ok()) return got.status();
  end_ += *got;
  at_end_ = *got == 0;
  return absl::OkStatus();
}

std::string FileLines::place() const {
  return absl::StrCat(file_.name(), ":", line_number_);
}

absl::Status FileLines::refuse(absl::string_view text, absl::string_view expected) const {
  return absl::InvalidArgumentError(absl::StrCat(place(), ": \"", excerpt(text), "\": ", expected));
}

}  // namespace isofield
