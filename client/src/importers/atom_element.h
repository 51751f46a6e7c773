#pragma once

#include <absl/strings/string_view.h>

#include "importers/elements.h"

namespace isofield {

// True where the name of a residue is one that programs give to water: HOH, WAT, TIP3, SOL and others.
bool is_water(absl::string_view residue);

// True where the residue is one of the twenty amino acids or a plain nucleotide and cannot hold this element.
bool is_foreign(const Element& element, absl::string_view residue);

// Whether the columns of an atom's name in a PDB file tell where the element's symbol ends.
enum class NameColumns {
  // The symbol ends in the second column: "CA  " is calcium, " CA " an alpha carbon.
  kRightJustified,
  // Every name begins in the first column, which tells nothing of the symbol.
  kLeftJustified,
};

// The element of an atom for which the file states none, by its name and residue. A right-justified name is given with
// the blanks of its four columns. Amino acids and nucleotides hold light elements only, and an ion has its residue's
// name. Any other name that may mean a metal or a light atom of a ligand ("CD", "NA", "HG") means the light one. Null
// where the element stays unknown.
const Element* element_of_name(absl::string_view name, absl::string_view residue, NameColumns columns);

// The element of an atom's label in an XYZ file: a symbol in any case, an atomic number, an isotope ("13C", "2H"), an
// ion ("Fe3+") or a symbol with a number or other suffix ("C12", "Fe_2"). A label in capitals with a suffix that may
// mean a metal or a light atom ("CA1") means the light one. Null where the element stays unknown.
const Element* element_of_label(absl::string_view label);

// The element of an atom type of a force field. It is read like a label, but capitals without a suffix ("CA", "HO",
// "OW") mean the light element too.
const Element* element_of_force_field_name(absl::string_view name);

}  // namespace isofield
