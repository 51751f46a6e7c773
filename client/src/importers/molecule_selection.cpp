#include "importers/molecule_selection.h"

#include <absl/container/flat_hash_map.h>
#include <absl/container/flat_hash_set.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <utility>

#include "importers/atom_element.h"
#include "importers/import_report.h"

namespace isofield {
namespace {

// A list that keeps each name once, in the order of first use.
class NameList {
 public:
  void add(absl::string_view name) {
    if (known_.insert(name).second) names_.push_back(name);
  }
  bool has(absl::string_view name) const { return known_.contains(name); }
  bool empty() const { return names_.empty(); }
  std::string text() const {
    return absl::StrJoin(names_, ", ", [](std::string* out, absl::string_view name) {
      absl::StrAppend(out, name.empty() ? "one without a name" : name);
    });
  }

 private:
  absl::flat_hash_set<absl::string_view> known_;
  std::vector<absl::string_view> names_;
};

absl::Status missing(absl::string_view kind, absl::string_view name, const NameList& present) {
  return absl::InvalidArgumentError(absl::StrCat(kind, " ", name, " is not in the file, which has ",
                                                 present.empty() ? "none" : absl::StrCat("only ", present.text())));
}

absl::Status check_names(const Molecule& molecule, const ImportOptions& options) {
  NameList chains, altlocs;
  for (const MoleculeAtom& atom : molecule.atoms) {
    chains.add(atom.chain);
    if (!atom.altloc.empty()) altlocs.add(atom.altloc);
  }
  for (const std::string& chain : options.chains) {
    if (!chains.has(chain)) return missing("chain", chain, chains);
  }
  if (!options.altloc.empty() && !altlocs.has(options.altloc)) {
    return missing("alternate location", options.altloc, altlocs);
  }
  return absl::OkStatus();
}

// Chooses one alternate location for each residue. Chain and number identify a residue: where two kinds of residue
// share one place, they are alternate locations of each other.
class AltlocChoice {
 public:
  AltlocChoice(const Molecule& molecule, const ImportOptions& options) {
    for (const MoleculeAtom& atom : molecule.atoms) {
      if (!atom.altloc.empty()) count(atom);
    }
    // The locations are in the file's order, so that the first one of equal occupancies is taken.
    for (const Location& location : locations_) {
      const Location*& chosen = chosen_[location.residue];
      if (!chosen || (chosen->name != options.altloc &&
                      (location.name == options.altloc || location.mean() > chosen->mean() + kTie))) {
        chosen = &location;
      }
    }
  }

  bool takes(const MoleculeAtom& atom) const {
    return atom.altloc.empty() || chosen_.at({atom.chain, atom.number})->name == atom.altloc;
  }
  // Returns true where an atom that is taken is of another location than the one asked for, which its residue lacks.
  static bool stands_in(const MoleculeAtom& atom, const ImportOptions& options) {
    return !atom.altloc.empty() && !options.altloc.empty() && atom.altloc != options.altloc;
  }

 private:
  // Means of equal occupancies differ by rounding.
  static constexpr double kTie = 1e-6;
  // The chain and the number, which identify a residue.
  using Residue = std::pair<absl::string_view, absl::string_view>;
  struct Location {
    Residue residue;
    absl::string_view name;
    double occupancy = 0;
    int atoms = 0;
    double mean() const { return occupancy / atoms; }
  };

  void count(const MoleculeAtom& atom) {
    const Residue residue{atom.chain, atom.number};
    const auto [index, is_new] = index_.try_emplace(std::pair(residue, atom.altloc), locations_.size());
    if (is_new) locations_.push_back({residue, atom.altloc});
    Location& location = locations_[index->second];
    location.occupancy += atom.occupancy;
    ++location.atoms;
  }

  std::vector<Location> locations_;
  absl::flat_hash_map<std::pair<Residue, absl::string_view>, std::size_t> index_;
  absl::flat_hash_map<Residue, const Location*> chosen_;
};

}  // namespace

absl::StatusOr<std::vector<const MoleculeAtom*>> choose_atoms(const Molecule& molecule, const ImportOptions& options,
                                                              ImportReport& report) {
  if (auto status = check_names(molecule, options); !status.ok()) return status;
  const AltlocChoice altlocs(molecule, options);
  std::vector<const MoleculeAtom*> chosen;
  for (const MoleculeAtom& atom : molecule.atoms) {
    const AtomSource& at = atom.source;
    const bool water = is_water(atom.residue);
    if (!options.chains.empty() &&
        std::find(options.chains.begin(), options.chains.end(), atom.chain) == options.chains.end()) {
      note(report, "atom left out: of another chain", at.line_number, at.line, false);
    } else if (water && !options.keep_waters) {
      note(report, "atom left out: water", at.line_number, at.line, false);
    } else if (water && !atom.element) {
      note(report, "site left out: a force centre of a water model, which is no atom", at.line_number, at.line, false);
    } else if (!altlocs.takes(atom)) {
      note(report, "atom left out: an alternate location", at.line_number, at.line, false);
    } else if (!leave_out_hydrogen(atom.element, at, options, report)) {
      if (altlocs.stands_in(atom, options)) {
        note(report,
             absl::StrCat("atom of another alternate location than ", options.altloc,
                          ", which its residue lacks: the one of the highest occupancy is taken"),
             at.line_number, at.line, false);
      }
      chosen.push_back(&atom);
    }
  }
  return chosen;
}

absl::StatusOr<const Assembly*> choose_assembly(const Molecule& molecule, const ImportOptions& options) {
  if (options.assembly.empty()) return nullptr;
  NameList names;
  for (const Assembly& assembly : molecule.assemblies) {
    if (assembly.name == options.assembly) return &assembly;
    names.add(assembly.name);
  }
  return missing("assembly", options.assembly, names);
}

}  // namespace isofield
