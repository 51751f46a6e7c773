#pragma once

#include <string>
#include <vector>

#include "importers/molecule.h"

namespace isofield {

// A CIF text whose loop of atoms (_atom_site) a strict reader takes.
struct CifLines {
  std::string text;
  // Of each atom of the loop; empty where the file does not have one atom a line. Views into the whole text.
  std::vector<AtomSource> atoms;
};

// Where atoms have one line each, blanks those lines that have too few or too many values, such as the last one of a
// file that was cut off, or characters that CIF does not have; with a note each. Lines keep their numbers.
CifLines mend_cif(const std::string& text, ImportReport& report);

}  // namespace isofield
