// Chooses the atoms of a molecule that are imported.
#pragma once

#include <absl/status/statusor.h>

#include <vector>

#include "importers/molecule.h"

namespace isofield {

// Returns the atoms that the options choose by chain, alternate location, water and hydrogen, in the order of the file.
// Notes the atoms that are left out. INVALID_ARGUMENT: no atom has a chain or the alternate location that the options
// name.
absl::StatusOr<std::vector<const MoleculeAtom*>> choose_atoms(const Molecule& molecule, const ImportOptions& options,
                                                              ImportReport& report);

// Returns the assembly that the options name, or null where they name none. INVALID_ARGUMENT: the molecule has none of
// that name.
absl::StatusOr<const Assembly*> choose_assembly(const Molecule& molecule, const ImportOptions& options);

}  // namespace isofield
