#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <memory>
#include <string>
#include <vector>

#include "points/input_file.h"

namespace isofield {

// The beginning of a text that others wrote, for errors: at most 80 characters, all printable ASCII.
std::string excerpt(absl::string_view text);

// The lines of a text, read by blocks. Single-threaded.
class LineReader {
 public:
  // "-" is the standard input. NOT_FOUND, PERMISSION_DENIED ...: the file cannot be opened.
  static absl::StatusOr<std::unique_ptr<LineReader>> open(const std::string& path);

  // False at the end. The line lives until the next call. INVALID_ARGUMENT: longer than 1 MiB; says what is expected.
  absl::StatusOr<bool> next(absl::string_view& line, const char* expected);

  // The file's name and the number of the line last returned: "points.csv:12".
  std::string place() const;
  // INVALID_ARGUMENT at that place, with an excerpt of `text`, a part of the line.
  absl::Status refuse(absl::string_view text, const std::string& expected) const;

 private:
  LineReader(InputFile file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}
  absl::Status fill(const char* expected);

  static constexpr std::size_t kBlockBytes = 1 << 20;
  InputFile file_;
  const std::string name_;
  std::vector<char> block_ = std::vector<char>(kBlockBytes);
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t line_number_ = 0;
  bool at_end_ = false;
};

}  // namespace isofield
