#include "points/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace isofield {

absl::StatusOr<InputFile> InputFile::open(const std::string& path) {
  FILE* const file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
  if (!file) return absl::ErrnoToStatus(errno, path);
  InputFile input(file, path == "-" ? "<stdin>" : path);
  constexpr std::size_t kStart = 512;
  std::string start(kStart, '\0');
  const auto got = input.read(start.data(), kStart);
  if (!got.ok()) return got.status();
  start.resize(*got);
  input.start_ = std::move(start);
  return input;
}

absl::StatusOr<std::size_t> InputFile::read(void* data, std::size_t bytes) {
  const std::size_t kept = std::min(bytes, start_.size() - start_read_);
  if (kept > 0) std::memcpy(data, start_.data() + start_read_, kept);
  start_read_ += kept;
  const std::size_t got = std::fread(static_cast<char*>(data) + kept, 1, bytes - kept, file_.get());
  if (got < bytes - kept && std::ferror(file_.get())) return absl::ErrnoToStatus(errno, name_);
  return kept + got;
}

}  // namespace isofield
