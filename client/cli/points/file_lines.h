#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <string>
#include <vector>

#include "excerpt.h"
#include "points/input_file.h"

namespace isofield {

// Reads a text line by line, in blocks of the file. Lines end at LF, CR LF or CR. It owns the file and is
// single-threaded.
class FileLines {
 public:
  explicit FileLines(InputFile file) : file_(std::move(file)) {}

  // Sets `line` to the next line, which is valid until the next call. Returns false at the end. INVALID_ARGUMENT: the
  // line is longer than 1 MiB; the message says what is expected. Other errors are those of InputFile::read().
  absl::StatusOr<bool> next(absl::string_view& line, const char* expected);

  const std::string& name() const { return file_.name(); }
  // The file's name and the number of the line last returned: "points.csv:12".
  std::string place() const;
  // Returns INVALID_ARGUMENT with that place, an excerpt of `text`, which is a part of the line, and what is expected.
  absl::Status refuse(absl::string_view text, absl::string_view expected) const;

 private:
  void find_next(char wanted, std::size_t& place) const;
  const char* find_line_end();
  absl::Status fill(const char* expected);

  static constexpr std::size_t kBlockBytes = 1 << 20;
  InputFile file_;
  std::vector<char> block_ = std::vector<char>(kBlockBytes);
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  // The places of the next LF and CR, or end_ where the block has none. Each part of the block is searched once.
  std::size_t next_lf_ = 0;
  std::size_t next_cr_ = 0;
  std::size_t line_number_ = 0;
  bool at_end_ = false;
  bool after_cr_ = false;
};

}  // namespace isofield
