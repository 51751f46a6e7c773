#include <absl/container/flat_hash_set.h>
#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>

#include <algorithm>

#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/molecule.h"
#include "importers/text.h"

namespace isofield {
namespace {

// Columns as the format's description counts them: from 1, both ends included.
absl::string_view columns(absl::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? absl::string_view() : line.substr(first - 1, last - first + 1);
}

absl::string_view trimmed(absl::string_view line, std::size_t first, std::size_t last) {
  return absl::StripAsciiWhitespace(columns(line, first, last));
}

// The element columns; else the atom name, whose first two columns hold the symbol, right-justified ("CA" is calcium,
// " CA" an alpha carbon), but for hydrogens with four letters ("HG11").
const Element* element_of(absl::string_view line) {
  if (const Element* stated = find_element(trimmed(line, 77, 78))) return stated;
  const absl::string_view name = columns(line, 13, 16);
  const absl::string_view head = absl::StripAsciiWhitespace(name.substr(0, std::min<std::size_t>(2, name.size())));
  const bool full_hydrogen = name.size() == 4 && !absl::ascii_isspace(name[3]) && (name[0] == 'H' || name[0] == 'h');
  if (!full_hydrogen) {
    if (const Element* element = find_element(head)) return element;
  }
  const std::size_t letter = name.find_first_not_of(" 0123456789'\"*");
  return letter == absl::string_view::npos ? nullptr : find_element(name.substr(letter, 1));
}

bool is_water(absl::string_view residue) {
  for (const char* name : {"HOH", "WAT", "DOD", "H2O", "SOL", "TIP", "TIP3", "TP3"}) {
    if (absl::EqualsIgnoreCase(residue, name)) return true;
  }
  return false;
}

// "A/ALA17/CA". Dots separate names from fields in edits and may not stand in a name.
std::string atom_name(absl::string_view line) {
  const absl::string_view chain = trimmed(line, 22, 22);
  return absl::StrReplaceAll(absl::StrCat(chain, chain.empty() ? "" : "/", trimmed(line, 18, 20), trimmed(line, 23, 27),
                                          "/", trimmed(line, 13, 16)),
                             {{".", "_"}, {"#", "_"}});
}

}  // namespace

absl::Status import_pdb(const std::string& text, const ImportOptions& options, Imported& imported) {
  ImportReport& report = imported.report;
  report.format = "molecule (PDB)";
  imported.scene.set_unit("angstrom");
  LineReader lines(text);
  absl::string_view line;
  // Chain, residue and atom name: the identity of an atom but for its alternate locations.
  absl::flat_hash_set<std::string> seen;
  absl::flat_hash_set<std::string> names;
  std::size_t models = 0;
  bool in_first_model = true;
  while (lines.next_raw(line)) {
    if (absl::StartsWith(line, "MODEL ")) in_first_model = ++models == 1;
    if (!absl::StartsWith(line, "ATOM  ") && !absl::StartsWith(line, "HETATM")) continue;
    ++report.read;
    if (!in_first_model) {
      note(report, "atom left out: not of the first model", lines.number(), line, false);
      continue;
    }
    if (!options.keep_waters && is_water(trimmed(line, 18, 21))) {
      note(report, "atom left out: water", lines.number(), line, false);
      continue;
    }
    const auto x = parse_length(trimmed(line, 31, 38));
    const auto y = parse_length(trimmed(line, 39, 46));
    const auto z = parse_length(trimmed(line, 47, 54));
    if (!x || !y || !z) {
      note(report, "atom dropped: columns 31 to 54 do not hold three finite coordinates of a usable size",
           lines.number(), line);
      continue;
    }
    const absl::string_view alternate = trimmed(line, 17, 17);
    const std::string identity = absl::StrCat(columns(line, 13, 16), columns(line, 18, 27));
    if (!seen.insert(identity).second && !alternate.empty()) {
      note(report, "atom left out: an alternate location", lines.number(), line, false);
      continue;
    }
    v1::Node& node = add_atom(element_of(line), {*x, *y, *z}, {lines.number(), line}, options, imported);
    std::string name = atom_name(line);
    if (names.insert(name).second) node.set_name(std::move(name));
  }
  if (report.read == 0) return absl::InvalidArgumentError("no ATOM or HETATM record");
  return absl::OkStatus();
}

}  // namespace isofield
