#include "importers/molecule.h"

#include <absl/container/flat_hash_map.h>
#include <absl/container/flat_hash_set.h>
#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <cmath>
#include <glm/matrix.hpp>

#include "importers/import_options.h"
#include "importers/import_report.h"
#include "importers/molecule_selection.h"

namespace isofield {
namespace {

// The default of ImportOptions::range_factor for molecules.
constexpr double kRangeFactor = 0.5;
// No daemon takes a scene of so many atoms. The limit bounds what a damaged list of operators can ask for.
constexpr std::size_t kMostAtoms = 50'000'000;

// Returns the name "CHAIN/RESIDUE/ATOM" of an atom. Characters that could break a name become '_': in edits a dot ends
// the name of a node and a leading '#' stands for an index, and the strings of a scene are UTF-8.
std::string node_name(const MoleculeAtom& atom, int copy) {
  std::string chain(atom.chain);
  if (copy > 1) absl::StrAppend(&chain, "-", copy);
  std::string name;
  for (const std::string& part : {chain, absl::StrCat(atom.residue, atom.number), std::string(atom.name)}) {
    if (!part.empty()) absl::StrAppend(&name, name.empty() ? "" : "/", part);
  }
  for (char& c : name) {
    if (c == '.' || c == '#' || !absl::ascii_isgraph(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

bool is_rigid(const RigidMotion& motion) {
  // Files state matrices with at least six decimals.
  constexpr double kTolerance = 0.01;
  const glm::dmat3 product = motion.rotation * glm::transpose(motion.rotation);
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(motion.shift[i])) return false;
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(product[i][j] - (i == j)) < kTolerance)) return false;
    }
  }
  return true;
}

// Adds atoms to a scene, and names those whose names are unique.
class AtomAdder {
 public:
  AtomAdder(const ImportOptions& options, Imported& imported) : options_(options), imported_(imported) {}

  void add(const MoleculeAtom& atom, const glm::dvec3& center, int copy) {
    v1::Node& node = add_atom(atom.element, center, atom.source, options_, imported_);
    std::string name = node_name(atom, copy);
    if (!name.empty() && names_.insert(name).second) node.set_name(std::move(name));
  }

 private:
  const ImportOptions& options_;
  Imported& imported_;
  absl::flat_hash_set<std::string> names_;
};

using Atoms = std::vector<const MoleculeAtom*>;
using AtomsByChain = absl::flat_hash_map<absl::string_view, Atoms>;

// The chains of a part that have atoms, each of them once.
std::vector<absl::string_view> present_chains(const Assembly::Part& part, const AtomsByChain& atoms) {
  std::vector<absl::string_view> chains;
  absl::flat_hash_set<absl::string_view> seen;
  for (const absl::string_view chain : part.chains) {
    if (atoms.contains(chain) && seen.insert(chain).second) chains.push_back(chain);
  }
  return chains;
}

absl::Status add_assembly(const Assembly& assembly, const Atoms& atoms, AtomAdder& adder, ImportReport& report) {
  AtomsByChain by_chain;
  for (const MoleculeAtom* atom : atoms) by_chain[atom->assembly_chain].push_back(atom);
  absl::flat_hash_map<absl::string_view, int> copies;
  std::size_t added = 0;
  for (const Assembly::Part& part : assembly.parts) {
    const auto chains = present_chains(part, by_chain);
    for (const absl::string_view chain : chains) added += by_chain[chain].size() * part.motions.size();
    if (added > kMostAtoms) {
      return absl::InvalidArgumentError(
          absl::StrCat("assembly ", assembly.name, " has ", added, " atoms; expected ", kMostAtoms, " at most"));
    }
    for (const RigidMotion& motion : part.motions) {
      if (!is_rigid(motion)) {
        return absl::InvalidArgumentError(
            absl::StrCat("an operator of assembly ", assembly.name, " is not a rotation with a shift"));
      }
      for (const absl::string_view chain : chains) {
        const int copy = ++copies[chain];
        for (const MoleculeAtom* atom : by_chain[chain]) adder.add(*atom, motion(atom->center), copy);
      }
    }
  }
  for (const MoleculeAtom* atom : atoms) {
    if (!copies.contains(atom->assembly_chain)) {
      note(report, "atom left out: not in the assembly", atom->source.line_number, atom->source.line, false);
    }
  }
  return absl::OkStatus();
}

}  // namespace

v1::Node& add_atom(const Element* element, const glm::dvec3& center, const AtomSource& source,
                   const ImportOptions& options, Imported& imported) {
  double radius = element ? element->radius : 0;
  if (radius == 0) {
    note(imported.report, "atom without a known van der Waals radius: 2.0 angstrom used", source.line_number,
         source.line);
    radius = kUnknownElementRadius;
  }
  v1::Node& node = *imported.scene.add_nodes();
  v1::Sphere& sphere = *node.mutable_sphere();
  for (int axis = 0; axis < 3; ++axis) sphere.add_center(center[axis]);
  sphere.set_radius(radius);
  sphere.set_range(range_of(options, kRangeFactor, radius));
  return node;
}

bool leave_out_hydrogen(const Element* element, const AtomSource& source, const ImportOptions& options,
                        ImportReport& report) {
  if (options.keep_hydrogens || !element || element->symbol != "H") return false;
  note(report, "atom left out: hydrogen", source.line_number, source.line, false);
  return true;
}

absl::Status add_molecule(const Molecule& molecule, const ImportOptions& options, Imported& imported) {
  const auto chosen = choose_atoms(molecule, options, imported.report);
  if (!chosen.ok()) return chosen.status();
  const auto assembly = choose_assembly(molecule, options);
  if (!assembly.ok()) return assembly.status();
  AtomAdder adder(options, imported);
  if (*assembly) return add_assembly(**assembly, *chosen, adder, imported.report);
  for (const MoleculeAtom* atom : *chosen) adder.add(*atom, atom->center, 1);
  return absl::OkStatus();
}

absl::StatusOr<int> choose_frame(absl::string_view kind, int frames, const ImportOptions& options,
                                 ImportReport& report) {
  const int frame = options.frame.value_or(1);
  if (frame > frames) {
    return absl::InvalidArgumentError(absl::StrCat(kind, " ", frame, " is not in the file, which has ", frames, " ",
                                                   kind, frames == 1 ? "" : "s",
                                                   frames > 1    ? absl::StrCat("; expected 1 to ", frames)
                                                   : frames == 1 ? "; expected 1"
                                                                 : ""));
  }
  if (frames > 1) {
    note(report, absl::StrCat("file of ", frames, " ", kind, "s: ", kind, " ", frame, " is taken"), 0, "", false);
  }
  return frame;
}

}  // namespace isofield
