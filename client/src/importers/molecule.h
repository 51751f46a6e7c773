#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <array>
#include <string>
#include <vector>

#include "importers/elements.h"
#include "isofield/import.h"

namespace isofield {

// An atom's place in its file, for the report.
struct AtomSource {
  std::size_t line_number;
  absl::string_view line;
};

// Adds a van der Waals sphere; notes an element that is unknown (null) or has no radius. Returns the new node, still
// without a name.
v1::Node& add_atom(const Element* element, const std::array<double, 3>& center, const AtomSource& source,
                   const ImportOptions& options, Imported& imported);

// True, with a note, where ImportOptions::keep_hydrogens leaves this element out.
bool leave_out_hydrogen(const Element* element, const AtomSource& source, const ImportOptions& options,
                        ImportReport& report);

// An atom of a macromolecule. All views are into texts that outlive it, and empty where the file says nothing.
struct MoleculeAtom {
  // Null: unknown.
  const Element* element = nullptr;
  std::array<double, 3> center{};
  absl::string_view chain;
  // What the operators of assemblies are listed for: the chain in PDB, the smaller label_asym_id in mmCIF.
  absl::string_view assembly_chain;
  // Such as "ALA".
  absl::string_view residue;
  // With the insertion code: "17" or "17A".
  absl::string_view number;
  // Such as "CA".
  absl::string_view name;
  absl::string_view altloc;
  double occupancy = 1;
  AtomSource source{};
};

// Rotates, then shifts; in angstrom.
struct RigidMotion {
  std::array<std::array<double, 3>, 3> rotation{};
  std::array<double, 3> shift{};
};

// The copies of chains that make a biological assembly.
struct Assembly {
  struct Part {
    // By MoleculeAtom::assembly_chain.
    std::vector<std::string> chains;
    std::vector<RigidMotion> motions;
  };
  std::string name;
  std::vector<Part> parts;
};

// One model of a PDB or mmCIF file.
struct Molecule {
  std::vector<MoleculeAtom> atoms;
  std::vector<Assembly> assemblies;
};

// Adds the atoms that the options choose, named "CHAIN/RESIDUE/ATOM" where that is unique, and notes those that they
// leave out. INVALID_ARGUMENT: the options name a chain, alternate location or assembly that the molecule lacks.
absl::Status add_molecule(const Molecule& molecule, const ImportOptions& options, Imported& imported);

// Chooses a model (PDB, mmCIF) or frame (XYZ) by its place, counted from 1, and notes the choice where there are more
// than one. INVALID_ARGUMENT: ImportOptions::frame is beyond the last. `kind` is the format's own word for a frame.
absl::StatusOr<int> choose_frame(absl::string_view kind, int frames, const ImportOptions& options,
                                 ImportReport& report);

}  // namespace isofield
