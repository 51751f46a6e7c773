#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <array>

#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/molecule.h"
#include "importers/text.h"

namespace isofield {
namespace {

// Fields first, first + 1, first + 2.
bool parse_center(const std::vector<absl::string_view>& fields, std::size_t first, std::array<double, 3>& center) {
  if (fields.size() < first + 3) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_length(fields[first + axis]);
    if (!value) return false;
    center[axis] = *value;
  }
  return true;
}

const Element* element_of(absl::string_view field) {
  if (const auto number = parse_integer(field)) return find_element(*number);
  // Some programs number the atoms: "C12".
  const std::size_t digits = field.find_first_of("0123456789");
  return find_element(field.substr(0, digits));
}

// After the count line.
void import_atoms(long long count, LineReader& lines, const ImportOptions& options, Imported& imported) {
  imported.report.format = "molecule (XYZ)";
  imported.scene.set_unit("angstrom");
  const std::size_t count_line = lines.number();
  absl::string_view line;
  lines.next(line);  // the comment
  long long read = 0;
  while (lines.next(line)) {
    if (read == count) {
      if (line.empty()) continue;
      const bool frame = parse_integer(line).has_value();
      note(
          imported.report,
          frame ? "line left out: a further frame" : "line dropped: more atoms than the count in the first line states",
          lines.number(), line, !frame);
      if (frame) break;
      continue;
    }
    ++read;
    ++imported.report.read;
    const auto fields = split_fields(line);
    std::array<double, 3> center;
    if (!parse_center(fields, 1, center)) {
      note(imported.report, "line dropped: expected \"element x y z\" with finite numbers of a usable size",
           lines.number(), line);
      continue;
    }
    add_atom(element_of(fields[0]), center, {lines.number(), line}, options, imported);
  }
  if (read < count) {
    note(imported.report, "file ends early: fewer atoms than its count states", count_line, absl::StrCat(count));
  }
}

}  // namespace

absl::Status import_xyz(const std::string& text, const ImportOptions& options, Imported& imported) {
  LineReader lines(text);
  absl::string_view line;
  while (lines.next(line)) {
    if (line.empty() || line.front() == '#') continue;
    const auto fields = split_fields(line);
    const auto count = parse_integer(fields[0]);
    if (fields.size() != 1 || !count || *count < 0) return import_points(text, options, imported);
    import_atoms(*count, lines, options, imported);
    break;
  }
  return absl::OkStatus();
}

}  // namespace isofield
