// Repairs PDB texts, so that a strict reader can read them.
#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <deque>
#include <string>
#include <vector>

#include "importers/elements.h"
#include "importers/molecule.h"

namespace isofield {

// The texts in the columns of an ATOM or HETATM record; gemmi reads the coordinates and the occupancy.
struct PdbAtomLine {
  AtomSource source{};
  const Element* element = nullptr;
  absl::string_view name, altloc, residue, chain, number;
};

// One model of a PDB file as text that a strict reader accepts. It holds the records of assemblies (REMARK 350), and
// ATOM and HETATM records of 80 columns with numbers in all fields. The serial number of a record, in hybrid-36, is the
// index of its line in `atoms`. `mended` owns the lines that had to be mended, and `atoms` has views into them: the
// struct may be moved, but not copied.
struct PdbLines {
  std::string text;
  std::vector<PdbAtomLine> atoms;
  std::deque<std::string> mended;
};

// Chooses the model, mends lines and drops those that cannot be mended; each of these is noted. Frames that END records
// separate count as models too. The views refer to `text` and to the result. INVALID_ARGUMENT: there are no atoms, or
// more in one model than there are serial numbers, or ImportOptions::frame is beyond the last model.
absl::StatusOr<PdbLines> mend_pdb(const std::string& text, const ImportOptions& options, ImportReport& report);

}  // namespace isofield
