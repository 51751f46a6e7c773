#include <absl/strings/str_cat.h>

#include <algorithm>

#include "importers/atom_element.h"
#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/molecule.h"
#include "importers/text.h"
#include "importers/tinker.h"
#include "importers/xyz_columns.h"
#include "importers/xyz_frames.h"

namespace isofield {
namespace {

bool states_columns(const std::vector<TextLine>& lines, std::size_t comment_line) {
  bool valid = true;
  return comment_line < lines.size() && parse_columns(lines[comment_line].text, valid);
}

// Returns the columns that the comment of the frame states, or "element x y z".
XyzColumns columns_of(const std::vector<TextLine>& lines, const XyzFrame& frame, ImportReport& report) {
  if (frame.comment_line >= lines.size()) return {};
  const TextLine& comment = lines[frame.comment_line];
  bool valid = true;
  const auto columns = parse_columns(comment.text, valid);
  if (!valid) {
    note(report, "columns of \"Properties=\" not understood: \"element x y z\" is read", comment.number, comment.text);
  }
  return columns.value_or(XyzColumns());
}

const Element* element_in(const std::vector<absl::string_view>& fields, const XyzColumns& columns) {
  const Element* element = nullptr;
  if (columns.species && *columns.species < fields.size()) element = element_of_label(fields[*columns.species]);
  if (!element && columns.number && *columns.number < fields.size()) {
    if (const auto number = parse_integer(fields[*columns.number])) element = find_element(*number);
  }
  return element;
}

void import_atom(const TextLine& line, const XyzColumns& columns, double scale, const ImportOptions& options,
                 Imported& imported) {
  const auto fields = split_fields(line.text);
  glm::dvec3 center;
  if (!parse_center(fields, columns.position, center)) {
    note(imported.report,
         absl::StrCat("line dropped: expected finite numbers of a usable size for x, y and z in its fields ",
                      columns.position + 1, " to ", columns.position + 3),
         line.number, line.text);
    return;
  }
  const AtomSource source{line.number, line.text};
  const Element* const element = element_in(fields, columns);
  if (leave_out_hydrogen(element, source, options, imported.report)) return;
  add_atom(element, scale * center, source, options, imported);
}

void import_frame(const std::vector<TextLine>& lines, const XyzFrame& frame, const ImportOptions& options,
                  Imported& imported) {
  ImportReport& report = imported.report;
  const TextLine& header = lines[frame.header_line];
  if (frame.header.scale != 1) note(report, "lengths converted from bohr", header.number, header.text, false);
  if (frame.comment_line == kNoComment) {
    note(report, "comment line missing: the atoms follow the count", header.number, header.text);
  }
  const XyzColumns columns = columns_of(lines, frame, report);
  long long read = 0;
  for (std::size_t at = frame.first_atom; at < frame.end; ++at) {
    if (lines[at].text.empty()) continue;
    ++read;
    import_atom(lines[at], columns, frame.header.scale, options, imported);
  }
  report.read += static_cast<std::size_t>(read);
  if (read < frame.header.count) {
    note(report, "frame ends early: fewer atoms than its count states", header.number, header.text);
  }
  for (std::size_t at = frame.end; at < frame.next; ++at) {
    if (lines[at].text.empty()) continue;
    note(report, "line dropped: more atoms than the count in the first line states", lines[at].number, lines[at].text);
  }
}

// Returns the text without the count before its points, and without the comment if there is one. Lines keep their
// numbers.
std::string without_header(const std::string& text, const std::vector<TextLine>& lines, std::size_t header_line) {
  std::size_t first = header_line + 1;
  if (!are_numbers(split_fields(lines[first].text))) ++first;
  if (first >= lines.size()) return {};
  const auto offset = static_cast<std::size_t>(lines[first].text.data() - text.data());
  return std::string(lines[first].number - 1, '\n') + text.substr(offset);
}

}  // namespace

absl::Status import_xyz(const std::string& text, const ImportOptions& options, Imported& imported) {
  const std::vector<TextLine> lines = read_lines(text);
  const auto first = std::find_if(lines.begin(), lines.end(),
                                  [](const TextLine& line) { return !line.text.empty() && line.text.front() != '#'; });
  const auto header_line = static_cast<std::size_t>(first - lines.begin());
  const auto header = first == lines.end() ? std::nullopt : parse_header(first->text);
  if (!header) return import_points(text, options, imported);
  if (is_tinker(lines, header_line)) return import_tinker(lines, header_line, options, imported);
  if (!states_columns(lines, header_line + 1) && are_points(lines, header_line, *header)) {
    return import_points(without_header(text, lines, header_line), options, imported);
  }
  imported.report.format = "molecule (XYZ)";
  imported.scene.set_unit("angstrom");
  const auto frames = find_frames(lines, header_line);
  const auto chosen = choose_frame("frame", static_cast<int>(frames.size()), options, imported.report);
  if (!chosen.ok()) return chosen.status();
  import_frame(lines, frames[static_cast<std::size_t>(*chosen) - 1], options, imported);
  return absl::OkStatus();
}

}  // namespace isofield
