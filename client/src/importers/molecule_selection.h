#pragma once

#include <absl/status/statusor.h>

#include <vector>

#include "importers/molecule.h"

namespace isofield {

// The atoms that the options choose by chain, alternate location, water and hydrogen, in the file's order. Atoms that
// are left out are noted. INVALID_ARGUMENT: no atom has a chain or the alternate location that the options name.
absl::StatusOr<std::vector<const MoleculeAtom*>> choose_atoms(const Molecule& molecule, const ImportOptions& options,
                                                              ImportReport& report);

// The assembly that the options name; null where they name none. INVALID_ARGUMENT: the molecule has none of that name.
absl::StatusOr<const Assembly*> choose_assembly(const Molecule& molecule, const ImportOptions& options);

}  // namespace isofield
