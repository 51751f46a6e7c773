#include "importers/tinker.h"

#include "importers/atom_element.h"
#include "importers/import_report.h"
#include "importers/molecule.h"
#include "importers/text.h"

namespace isofield {
namespace {

bool is_box(absl::string_view line) {
  const auto fields = split_fields(line);
  return fields.size() == 6 && are_numbers(fields);
}

bool is_numbered_atom(absl::string_view line) {
  const auto fields = split_fields(line);
  glm::dvec3 center;
  return fields.size() >= 5 && parse_integer(fields[0]) && !parse_double(fields[1]) && parse_center(fields, 2, center);
}

std::size_t skip_blank_lines(const std::vector<TextLine>& lines, std::size_t at) {
  while (at < lines.size() && lines[at].text.empty()) ++at;
  return at;
}

struct TinkerFrame {
  long long count;
  std::size_t header_line;
  // The lines of the atoms, from `begin` to before `end`.
  std::size_t begin, end;
};

// Finds the frames from the line `header_line` on. After as many atoms as its count states, a frame ends at the first
// line that is no atom.
std::vector<TinkerFrame> find_tinker_frames(const std::vector<TextLine>& lines, std::size_t header_line) {
  std::vector<TinkerFrame> frames;
  for (std::size_t at = header_line; at < lines.size(); at = skip_blank_lines(lines, at)) {
    const auto header = parse_header(lines[at].text);
    TinkerFrame frame{header ? header->count : 0, at, 0, 0};
    at = skip_blank_lines(lines, at + 1);
    if (at < lines.size() && is_box(lines[at].text)) ++at;
    frame.begin = at;
    for (long long atoms = 0; at < lines.size(); ++at) {
      if (atoms >= frame.count && !lines[at].text.empty() && !is_numbered_atom(lines[at].text)) break;
      atoms += !lines[at].text.empty();
    }
    frame.end = at;
    frames.push_back(frame);
  }
  return frames;
}

void import_frame(const std::vector<TextLine>& lines, const TinkerFrame& frame, const ImportOptions& options,
                  Imported& imported) {
  long long atoms = 0;
  for (std::size_t at = frame.begin; at < frame.end; ++at) {
    const auto& [number, line] = lines[at];
    if (line.empty()) continue;
    if (++atoms > frame.count) {
      note(imported.report, "line dropped: more atoms than the count in the first line states", number, line);
      continue;
    }
    ++imported.report.read;
    if (!is_numbered_atom(line)) {
      note(imported.report, "line dropped: expected \"number name x y z\" with finite numbers of a usable size", number,
           line);
      continue;
    }
    const auto fields = split_fields(line);
    const Element* const element = element_of_force_field_name(fields[1]);
    const AtomSource source{number, line};
    if (leave_out_hydrogen(element, source, options, imported.report)) continue;
    glm::dvec3 center;
    parse_center(fields, 2, center);
    add_atom(element, center, source, options, imported);
  }
  if (atoms < frame.count) {
    note(imported.report, "frame ends early: fewer atoms than its count states", lines[frame.header_line].number,
         lines[frame.header_line].text);
  }
}

}  // namespace

bool is_tinker(const std::vector<TextLine>& lines, std::size_t header_line) {
  std::size_t at = skip_blank_lines(lines, header_line + 1);
  if (at < lines.size() && is_box(lines[at].text)) at = skip_blank_lines(lines, at + 1);
  return at < lines.size() && is_numbered_atom(lines[at].text);
}

absl::Status import_tinker(const std::vector<TextLine>& lines, std::size_t header_line, const ImportOptions& options,
                           Imported& imported) {
  imported.report.format = "molecule (Tinker XYZ)";
  imported.scene.set_unit("angstrom");
  const auto frames = find_tinker_frames(lines, header_line);
  const auto chosen = choose_frame("frame", static_cast<int>(frames.size()), options, imported.report);
  if (!chosen.ok()) return chosen.status();
  import_frame(lines, frames[static_cast<std::size_t>(*chosen) - 1], options, imported);
  return absl::OkStatus();
}

}  // namespace isofield
