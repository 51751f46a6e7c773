#include "points/line_reader.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <cerrno>
#include <cstring>

namespace isofield {

std::string excerpt(absl::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string result(text.substr(0, kMost));
  // A terminal obeys control characters, and half a character of several bytes is none.
  for (char& c : result) {
    if (!absl::ascii_isprint(static_cast<unsigned char>(c))) {
      c = absl::ascii_isspace(static_cast<unsigned char>(c)) ? ' ' : '?';
    }
  }
  return text.size() > kMost ? result.replace(kMost - 3, 3, "...") : result;
}

absl::StatusOr<std::unique_ptr<LineReader>> LineReader::open(const std::string& path) {
  InputFile file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) return absl::ErrnoToStatus(errno, path);
  return std::unique_ptr<LineReader>(new LineReader(std::move(file), path == "-" ? "<stdin>" : path));
}

absl::StatusOr<bool> LineReader::next(absl::string_view& line, const char* expected) {
  while (true) {
    const char* begin = block_.data() + begin_;
    const void* end = begin_ < end_ ? std::memchr(begin, '\n', end_ - begin_) : nullptr;
    if (end != nullptr || (at_end_ && begin_ < end_)) {
      const std::size_t length = end != nullptr ? static_cast<const char*>(end) - begin : end_ - begin_;
      line = absl::string_view(begin, length);
      begin_ += length + (end != nullptr ? 1 : 0);
      ++line_number_;
      // A byte order mark is no part of the text.
      if (line_number_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
      return true;
    }
    if (at_end_) return false;
    if (auto status = fill(expected); !status.ok()) return status;
  }
}

// Moves the rest of the block to its start and reads more behind it.
absl::Status LineReader::fill(const char* expected) {
  std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == block_.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat(name_, ":", line_number_ + 1, ": a line longer than 1 MiB; expected ", expected));
  }
  const std::size_t got = std::fread(block_.data() + end_, 1, block_.size() - end_, file_.get());
  end_ += got;
  if (got == 0) {
    if (std::ferror(file_.get())) return absl::ErrnoToStatus(errno, name_);
    at_end_ = true;
  }
  return absl::OkStatus();
}

std::string LineReader::place() const {
  return absl::StrCat(name_, ":", line_number_);
}

absl::Status LineReader::refuse(absl::string_view text, const std::string& expected) const {
  return absl::InvalidArgumentError(absl::StrCat(place(), ": \"", excerpt(text), "\": ", expected));
}

}  // namespace isofield
