#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <deque>
#include <string>
#include <vector>

#include "importers/elements.h"
#include "importers/molecule.h"

namespace isofield {

// What an ATOM or HETATM record says in its columns, but for the numbers.
struct PdbAtomLine {
  AtomSource source{};
  const Element* element = nullptr;
  absl::string_view name, altloc, residue, chain, number;
};

// One model of a PDB file, as text that a strict reader takes: the records of assemblies (REMARK 350), and ATOM and
// HETATM records of 80 columns with numbers in all fields. Their serial number is the index of their line in `atoms`,
// in hybrid-36. A mended line lives in `mended`; move, but do not copy.
struct PdbLines {
  std::string text;
  std::vector<PdbAtomLine> atoms;
  std::deque<std::string> mended;
};

// Chooses the model, mends lines and drops those that cannot be mended, with a note each. Frames that END parts are
// models too. The views are into `text` and the result. INVALID_ARGUMENT: no atoms, or ImportOptions::frame is beyond
// the last model.
absl::StatusOr<PdbLines> mend_pdb(const std::string& text, const ImportOptions& options, ImportReport& report);

}  // namespace isofield
