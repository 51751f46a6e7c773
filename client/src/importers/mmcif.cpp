#include <absl/container/flat_hash_map.h>
#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <exception>
#include <gemmi/numb.hpp>

#include "importers/atom_element.h"
#include "importers/cif_document.h"
#include "importers/cif_lines.h"
#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/mmcif_assembly.h"
#include "importers/molecule.h"
#include "importers/text.h"

namespace isofield {
namespace {

constexpr char kCategory[] = "_atom_site.";
// The tags in the form of gemmi: "?" stands before those that may be missing. Their order is that of Column.
const std::vector<std::string> kTags = {
    "Cartn_x",        "Cartn_y",           "Cartn_z",       "?id",           "?pdbx_PDB_model_num",
    "?type_symbol",   "?occupancy",        "?label_alt_id", "?auth_asym_id", "?label_asym_id",
    "?auth_comp_id",  "?label_comp_id",    "?auth_seq_id",  "?label_seq_id", "?auth_atom_id",
    "?label_atom_id", "?pdbx_PDB_ins_code"};
enum Column {
  kX,
  kY,
  kZ,
  kId,
  kModel,
  kSymbol,
  kOccupancy,
  kAltloc,
  kAuthorChain,
  kChain,
  kAuthorResidue,
  kResidue,
  kAuthorNumber,
  kNumber,
  kAuthorName,
  kName,
  kInsertion
};

// Returns a value without its quotes. It is empty where the file says "?" (unknown) or "." (not applicable).
absl::string_view text_of(const std::string& value) {
  if (gemmi::cif::is_null(value)) return {};
  absl::string_view text = value;
  if (text.size() >= 2 && (text[0] == '"' || text[0] == '\'')) text = text.substr(1, text.size() - 2);
  return text;
}

// The atoms of a data block. The columns may stand in any order, and only those of the coordinates must be there.
class AtomTable {
 public:
  AtomTable(gemmi::cif::Block& block, const CifLines& lines, ImportReport& report)
      : table_(block.find(kCategory, kTags)), lines_(lines), report_(report) {}

  // Counts the models, which differ in name, and numbers them from 1 in the order of their first atoms.
  int count_models() {
    absl::flat_hash_map<absl::string_view, int> models;
    for (const auto row : table_) {
      const int next = static_cast<int>(models.size()) + 1;
      model_of_row_.push_back(models.try_emplace(value(row, kModel), next).first->second);
    }
    return static_cast<int>(models.size());
  }

  std::vector<MoleculeAtom> atoms(int model) {
    std::vector<MoleculeAtom> atoms;
    std::size_t index = 0;
    for (const auto row : table_) {
      ++report_.read;
      const bool wanted = model_of_row_[index] == model;
      const AtomSource source = source_of(row, index++);
      MoleculeAtom atom;
      if (!wanted) {
        note(report_, "atom left out: of another model", source.line_number, source.line, false);
      } else if (!read_center(row, atom.center)) {
        note(report_, "atom dropped: Cartn_x, Cartn_y and Cartn_z are not three finite numbers of a usable size",
             source.line_number, source.line);
      } else {
        fill(row, atom);
        atom.source = source;
        atoms.push_back(atom);
      }
    }
    return atoms;
  }

 private:
  using Row = gemmi::cif::Table::Row;

  static absl::string_view value(const Row& row, int column) {
    return row.has(column) ? text_of(row[column]) : absl::string_view();
  }
  // Returns the name that the author gave, which PDB files have too, or the name of the archive where that is missing.
  static absl::string_view either(const Row& row, int author, int archive) {
    const absl::string_view name = value(row, author);
    return name.empty() ? value(row, archive) : name;
  }

  static bool read_center(const Row& row, glm::dvec3& center) {
    center = {gemmi::cif::as_number(row[kX]), gemmi::cif::as_number(row[kY]), gemmi::cif::as_number(row[kZ])};
    // An unreadable coordinate is NaN.
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(center[axis]) <= kLargestLength)) return false;
    }
    return true;
  }

  AtomSource source_of(const Row& row, std::size_t index) const {
    return lines_.atoms.size() == model_of_row_.size() ? lines_.atoms[index] : AtomSource{0, value(row, kId)};
  }

  void fill(const Row& row, MoleculeAtom& atom) {
    atom.chain = either(row, kAuthorChain, kChain);
    atom.assembly_chain = either(row, kChain, kAuthorChain);
    atom.residue = either(row, kAuthorResidue, kResidue);
    atom.name = either(row, kAuthorName, kName);
    atom.altloc = value(row, kAltloc);
    atom.number = either(row, kAuthorNumber, kNumber);
    if (const absl::string_view insertion = value(row, kInsertion); !insertion.empty()) {
      atom.number = numbers_.emplace_back(absl::StrCat(atom.number, insertion));
    }
    const double occupancy = row.has(kOccupancy) ? gemmi::cif::as_number(row[kOccupancy]) : 1;
    if (std::isfinite(occupancy)) atom.occupancy = occupancy;
    atom.element = find_element(value(row, kSymbol));
    if (!atom.element) atom.element = element_of_name(atom.name, atom.residue, NameColumns::kLeftJustified);
  }

  gemmi::cif::Table table_;
  const CifLines& lines_;
  ImportReport& report_;
  std::vector<int> model_of_row_;
  std::deque<std::string> numbers_;
};

gemmi::cif::Block* block_of_atoms(gemmi::cif::Document& document) {
  for (gemmi::cif::Block& block : document.blocks) {
    if (block.find_values("_atom_site.Cartn_x")) return &block;
  }
  return nullptr;
}

// Returns the error for a CIF without Cartesian coordinates.
absl::Status no_atoms(gemmi::cif::Document& document) {
  for (gemmi::cif::Block& block : document.blocks) {
    if (block.find_values("_atom_site_fract_x") || block.find_values("_atom_site.fract_x")) {
      return absl::InvalidArgumentError(
          "its atoms have fractional coordinates, as in the CIF of a crystal of small molecules; expected mmCIF with "
          "_atom_site.Cartn_x, Cartn_y and Cartn_z");
    }
  }
  return absl::InvalidArgumentError("no atoms: expected a loop of _atom_site.Cartn_x, Cartn_y and Cartn_z");
}

absl::Status import_document(gemmi::cif::Document& document, const CifLines& lines, const ImportOptions& options,
                             Imported& imported) {
  gemmi::cif::Block* const block = block_of_atoms(document);
  if (!block) return no_atoms(document);
  AtomTable table(*block, lines, imported.report);
  const auto model = choose_frame("model", table.count_models(), options, imported.report);
  if (!model.ok()) return model.status();
  Molecule molecule;
  molecule.atoms = table.atoms(*model);
  molecule.assemblies = read_assemblies(*block);
  return add_molecule(molecule, options, imported);
}

}  // namespace

absl::Status import_mmcif(const std::string& text, const ImportOptions& options, Imported& imported) {
  imported.scene.set_unit("angstrom");
  const bool json = absl::StartsWith(absl::StripLeadingAsciiWhitespace(text), "{");
  imported.report.format = json ? "molecule (mmJSON)" : "molecule (mmCIF)";
  CifLines lines;
  if (!json) lines = mend_cif(text, imported.report);
  auto document = json ? read_mmjson(text) : read_cif(lines.text);
  if (!document.ok()) return document.status();
  try {
    return import_document(*document, lines, options, imported);
  } catch (const std::exception& error) {
    return absl::InvalidArgumentError(absl::StrCat("not an mmCIF file that can be read: ", error.what()));
  }
}

}  // namespace isofield
