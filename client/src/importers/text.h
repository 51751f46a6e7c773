// Reads lines, fields and numbers of texts.
#pragma once

#include <absl/numeric/int128.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tables/number.h"

namespace isofield {

// Walks over the lines of a text, which end at LF, CR LF or CR, and drops the blanks at both ends of each. Keeps a view
// of the text.
class LineReader {
 public:
  explicit LineReader(absl::string_view text) : rest_(text) {}

  // Reads the next line. Returns false at the end of the text.
  bool next(absl::string_view& line);
  // Does the same, but keeps blanks at both ends, for formats of fixed columns.
  bool next_raw(absl::string_view& line);
  // Returns the number of the line that was read last, from 1.
  std::size_t number() const { return number_; }

 private:
  absl::string_view rest_;
  std::size_t number_ = 0;
};

// Returns the fields between blanks, tabs, commas and semicolons.
std::vector<absl::string_view> split_fields(absl::string_view line);

// The least length and the largest length or coordinate that the server takes in a scene.
inline constexpr double kLeastLength = 1e-9;
inline constexpr double kLargestLength = 1e9;
// Does the same as parse_double(), but also returns nothing for numbers that are too large for the coordinates of a
// scene.
std::optional<double> parse_length(absl::string_view field);
// These read whole numbers, which may also be written as "17.0" or, up to 2^53, as "1.7e1". parse_integer() takes
// signed numbers of 64 bits, parse_integer64() unsigned ones as well. They return nothing where the field is no such
// number.
std::optional<long long> parse_integer(absl::string_view field);
std::optional<absl::int128> parse_integer64(absl::string_view field);

// Returns "line 17: TEXT", where TEXT is the line, cut to a readable length.
std::string quote_line(std::size_t number, absl::string_view line);

}  // namespace isofield
