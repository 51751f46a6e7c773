#include "importers/xyz_frames.h"

#include <absl/strings/match.h>

#include <algorithm>

#include "importers/atom_element.h"
#include "importers/text.h"

namespace isofield {
namespace {

// The length of a bohr in angstrom.
constexpr double kBohr = 0.529177210903;

// Returns true for "element x y z" with a known element.
bool is_atom(absl::string_view line) {
  const auto fields = split_fields(line);
  glm::dvec3 center;
  return parse_center(fields, 1, center) && element_of_label(fields[0]);
}

bool is_lone_count(absl::string_view line) {
  const auto fields = split_fields(line);
  return fields.size() == 1 && parse_header(line);
}

// Returns true where exactly `count` lines from this one on are atoms.
bool holds_atoms(const std::vector<TextLine>& lines, std::size_t first, long long count) {
  long long atoms = 0;
  for (std::size_t at = first; at < lines.size() && atoms <= count && is_atom(lines[at].text); ++at) ++atoms;
  return atoms == count && count > 0;
}

void place_comment(const std::vector<TextLine>& lines, XyzFrame& frame) {
  const std::size_t at = frame.header_line + 1;
  frame.comment_line = at;
  if (holds_atoms(lines, at, frame.header.count)) {
    frame.comment_line = kNoComment;
  } else if (at + 1 < lines.size() && lines[at].text.empty() && !is_atom(lines[at + 1].text) &&
             holds_atoms(lines, at + 2, frame.header.count)) {
    // A blank line stands before the comment.
    frame.comment_line = at + 1;
  }
  frame.first_atom = frame.comment_line == kNoComment ? at : std::min(lines.size(), frame.comment_line + 1);
}

}  // namespace

std::vector<TextLine> read_lines(absl::string_view text) {
  std::vector<TextLine> result;
  LineReader lines(text);
  for (absl::string_view line; lines.next(line);) result.push_back({lines.number(), line});
  return result;
}

std::optional<XyzHeader> parse_header(absl::string_view line) {
  auto fields = split_fields(line);
  if (fields.empty()) return std::nullopt;
  const auto count = parse_integer(fields[0]);
  if (!count || *count < 0) return std::nullopt;
  fields.erase(fields.begin());
  if (!fields.empty() && parse_double(fields[0])) return std::nullopt;
  // A numbered atom, such as "1 O 0.0 0.0 0.0", is no header.
  if (glm::dvec3 center; parse_center(fields, 1, center)) return std::nullopt;
  XyzHeader header{*count, 1};
  if (fields.size() == 1 || (fields.size() == 2 && absl::EqualsIgnoreCase(fields[1], "units"))) {
    for (const char* unit : {"bohr", "bohrs", "au", "a.u.", "atomic"}) {
      if (absl::EqualsIgnoreCase(fields[0], unit)) header.scale = kBohr;
    }
  }
  return header;
}

std::vector<XyzFrame> find_frames(const std::vector<TextLine>& lines, std::size_t first) {
  std::vector<XyzFrame> frames;
  std::size_t at = first;
  while (at < lines.size()) {
    XyzFrame& frame = frames.emplace_back();
    frame.header = *parse_header(lines[at].text);
    frame.header_line = at;
    place_comment(lines, frame);
    at = frame.first_atom;
    for (long long atoms = 0; at < lines.size() && atoms < frame.header.count; ++at) {
      if (is_lone_count(lines[at].text)) break;
      atoms += !lines[at].text.empty();
    }
    frame.end = at;
    while (at < lines.size() && !parse_header(lines[at].text)) ++at;
    frame.next = at;
  }
  return frames;
}

bool are_points(const std::vector<TextLine>& lines, std::size_t header_line, const XyzHeader& header) {
  constexpr long long kComment = 1;
  long long atoms = 0, numbers = 0;
  bool atomic_numbers = true;
  long long seen = 0;
  for (std::size_t at = header_line + 1; at < lines.size() && seen < header.count + kComment; ++at) {
    const auto fields = split_fields(lines[at].text);
    if (fields.empty()) continue;
    if (++seen > 1 && is_lone_count(lines[at].text)) break;
    if (fields.size() >= 3 && are_numbers(fields)) {
      ++numbers;
      const auto number = parse_integer(fields[0]);
      atomic_numbers &= fields.size() >= 4 && number && find_element(*number);
    } else {
      atoms += is_atom(lines[at].text);
    }
  }
  return !atomic_numbers && numbers > atoms;
}

bool parse_center(const std::vector<absl::string_view>& fields, std::size_t first, glm::dvec3& center) {
  if (fields.size() < first + 3) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = parse_length(fields[first + static_cast<std::size_t>(axis)]);
    if (!value) return false;
    center[axis] = *value;
  }
  return true;
}

bool are_numbers(const std::vector<absl::string_view>& fields) {
  return std::all_of(fields.begin(), fields.end(),
                     [](absl::string_view field) { return parse_double(field).has_value(); });
}

}  // namespace isofield
