#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isofield {

// Walks over the lines of a text; ends lines at LF, CR LF or CR, and drops blanks at both ends.
class LineReader {
 public:
  explicit LineReader(absl::string_view text) : rest_(text) {}

  // False at the end.
  bool next(absl::string_view& line);
  // Keeps leading blanks, for formats of fixed columns.
  bool next_raw(absl::string_view& line);
  // From 1, of the line last read.
  std::size_t number() const { return number_; }

 private:
  absl::string_view rest_;
  std::size_t number_ = 0;
};

// Fields between blanks, tabs, commas and semicolons.
std::vector<absl::string_view> split_fields(absl::string_view line);

// The whole field as a number; infinities and NaN included. Nothing: not a number.
std::optional<double> parse_double(absl::string_view field);
// As parse_double, and of a size whose squares float32 can hold: what a scene's lengths must be.
std::optional<double> parse_length(absl::string_view field);
// Whole numbers, also written as "17.0".
std::optional<long long> parse_integer(absl::string_view field);

// "line 17: TEXT", cut to a readable length.
std::string quote_line(std::size_t number, absl::string_view line);

}  // namespace isofield
