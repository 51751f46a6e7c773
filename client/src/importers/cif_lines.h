// Repairs the atom lines of damaged CIF texts, so that a strict reader can read the rest.
#pragma once

#include <string>
#include <vector>

#include "importers/molecule.h"

namespace isofield {

// A CIF text whose loop of atoms (_atom_site) is clean enough for a strict reader.
struct CifLines {
  std::string text;
  // The line of each atom in the loop, as views into the original text; empty where atoms do not have one line each.
  std::vector<AtomSource> atoms;
};

// Empties the damaged lines of atoms and notes each of them, if atoms have one line each. Damaged lines have too few or
// too many values, such as the last line of a truncated file, or characters that CIF does not allow. Lines keep their
// numbers.
CifLines mend_cif(const std::string& text, ImportReport& report);

}  // namespace isofield
