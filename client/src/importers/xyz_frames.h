#pragma once

#include <absl/strings/string_view.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace isofield {

// A line without blanks at its ends.
struct TextLine {
  std::size_t number;
  absl::string_view text;
};

std::vector<TextLine> read_lines(absl::string_view text);

// The first line of a frame: "3", or with words after the count ("3 water").
struct XyzHeader {
  long long count = 0;
  // To angstrom: what the coordinates are multiplied by, where the words are a unit ("3 bohr").
  double scale = 1;
};

// Nothing: the line does not begin with a count >= 0, or goes on as a point or an atom does.
std::optional<XyzHeader> parse_header(absl::string_view line);

// A frame of "count, comment, lines of atoms"; indices of lines.
struct XyzFrame {
  XyzHeader header;
  std::size_t header_line = 0;
  // kNoComment: the atoms follow the count.
  std::size_t comment_line = 0;
  std::size_t first_atom = 0;
  // The line after the last of `count` lines; fewer where the next frame begins earlier.
  std::size_t end = 0;
  // Where the next frame begins; lines from `end` to here are more than the count states.
  std::size_t next = 0;
};
inline constexpr std::size_t kNoComment = static_cast<std::size_t>(-1);

// All frames from this line on, which must be a header.
std::vector<XyzFrame> find_frames(const std::vector<TextLine>& lines, std::size_t first);

// True where a count stands before lines that are points, "x y z" or more numbers of which the first is no atomic
// number, rather than atoms.
bool are_points(const std::vector<TextLine>& lines, std::size_t header_line, const XyzHeader& header);

// Fields first, first + 1, first + 2 as coordinates of a usable size.
bool parse_center(const std::vector<absl::string_view>& fields, std::size_t first, std::array<double, 3>& center);

// True where all fields are numbers.
bool are_numbers(const std::vector<absl::string_view>& fields);

}  // namespace isofield
