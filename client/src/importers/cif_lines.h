#pragma once

#include <string>
#include <vector>

#include "importers/molecule.h"

namespace isofield {

// A CIF text whose loop of atoms (_atom_site) is clean enough for a strict reader.
struct CifLines {
  std::string text;
  // The line of each atom in the loop, as views into the original text. Empty where atoms do not have one line each.
  std::vector<AtomSource> atoms;
};

// Where atoms have one line each, this empties the damaged lines and notes each of them: those with too few or too many
// values, such as the last line of a truncated file, and those with characters that CIF does not allow. Lines keep
// their numbers.
CifLines mend_cif(const std::string& text, ImportReport& report);

}  // namespace isofield
