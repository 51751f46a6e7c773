// Molecules as all readers of molecules hand them over, and the scene that is made of them.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "importers/elements.h"
#include "isofield/import.h"

namespace isofield {

// The place of an atom in its file, for the report.
struct AtomSource {
  std::size_t line_number;
  absl::string_view line;
};

// Adds a van der Waals sphere, and notes an element that is unknown (null) or has no radius. Returns the new node,
// which has no name yet.
v1::Node& add_atom(const Element* element, const glm::dvec3& center, const AtomSource& source,
                   const ImportOptions& options, Imported& imported);

// Returns true and notes it where the element is hydrogen and ImportOptions::keep_hydrogens is false.
bool leave_out_hydrogen(const Element* element, const AtomSource& source, const ImportOptions& options,
                        ImportReport& report);

// An atom of a macromolecule. The views refer to texts that outlive it; they are empty where the file says nothing.
struct MoleculeAtom {
  // Null where the element is unknown.
  const Element* element = nullptr;
  glm::dvec3 center{};
  absl::string_view chain;
  // The name by which assemblies refer to the chain. In PDB it is `chain`; in mmCIF it is label_asym_id, of which a
  // chain may have several.
  absl::string_view assembly_chain;
  // The name of its residue, such as "ALA".
  absl::string_view residue;
  // The number of its residue with the insertion code: "17" or "17A".
  absl::string_view number;
  // The atom's own name, such as "CA".
  absl::string_view name;
  // The name of the alternate location that it belongs to, such as "A".
  absl::string_view altloc;
  double occupancy = 1;
  AtomSource source{};
};

// A rotation followed by a shift in angstrom. rotation[i] is column i of the matrix.
struct RigidMotion {
  glm::dmat3 rotation{};
  glm::dvec3 shift{};

  glm::dvec3 operator()(const glm::dvec3& point) const {
    return shift + point.x * rotation[0] + point.y * rotation[1] + point.z * rotation[2];
  }
};

// The copies of chains that make a biological assembly.
struct Assembly {
  struct Part {
    // The names of chains, as in MoleculeAtom::assembly_chain. Each motion makes a copy of all these chains.
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

// Adds the atoms that the options choose and notes those that they leave out. An atom is named "CHAIN/RESIDUE/ATOM"
// where that is unique. INVALID_ARGUMENT: the options name a chain, alternate location or assembly that the molecule
// lacks, or an assembly that has too many atoms or an operator that is no rigid motion.
absl::Status add_molecule(const Molecule& molecule, const ImportOptions& options, Imported& imported);

// Chooses a model (PDB, mmCIF) or frame (XYZ) by its place, counted from 1, and notes the choice where there are more
// than one. `kind` is the format's own word, "model" or "frame". INVALID_ARGUMENT: ImportOptions::frame is beyond the
// last one.
absl::StatusOr<int> choose_frame(absl::string_view kind, int frames, const ImportOptions& options,
                                 ImportReport& report);

}  // namespace isofield
