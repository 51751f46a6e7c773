// Finds the frames of XYZ files, and tells atoms from points.
#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace isofield {

// A line without blanks at its ends.
struct TextLine {
  std::size_t number;
  absl::string_view text;
};

// Returns all lines of a text.
std::vector<TextLine> read_lines(absl::string_view text);

// The first line of a frame: a count ("3"), possibly with words after it ("3 water").
struct XyzHeader {
  long long count = 0;
  // The factor from the coordinates of the file to angstrom. It is not 1 where the words name another unit ("3 bohr").
  double scale = 1;
};

// Reads the first line of a frame. Returns nothing where the line does not begin with a count >= 0, or is a point or an
// atom.
std::optional<XyzHeader> parse_header(absl::string_view line);

// A frame of "count, comment, lines of atoms". All places are indices of lines.
struct XyzFrame {
  XyzHeader header;
  std::size_t header_line = 0;
  // The comment, or kNoComment where the atoms follow the count at once.
  std::size_t comment_line = 0;
  std::size_t first_atom = 0;
  // The line after the last atom. This is after as many atoms as the count states, or where the next frame begins
  // earlier.
  std::size_t end = 0;
  // The line at which the next frame begins. Lines from `end` to here are more atoms than the count states.
  std::size_t next = 0;
};
inline constexpr std::size_t kNoComment = static_cast<std::size_t>(-1);

// Returns all frames from the line `first` on, which must be a header.
std::vector<XyzFrame> find_frames(const std::vector<TextLine>& lines, std::size_t first);

// Returns true where the lines after a count are points rather than atoms: they are "x y z", or have more numbers, the
// first of which is not an atomic number in every line.
bool are_points(const std::vector<TextLine>& lines, std::size_t header_line, const XyzHeader& header);

// Reads the fields first, first + 1 and first + 2 as coordinates. Returns false where one is missing, is no number or
// is too large.
bool parse_center(const std::vector<absl::string_view>& fields, std::size_t first, glm::dvec3& center);

// Returns true where all fields are numbers.
bool are_numbers(const std::vector<absl::string_view>& fields);

}  // namespace isofield
