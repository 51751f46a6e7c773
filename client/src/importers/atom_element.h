// Finds out the elements of atoms from their names, where a file does not state them or states them in other words.
#pragma once

#include <absl/strings/string_view.h>

#include "importers/elements.h"

namespace isofield {

// Returns true where the name of a residue is one that programs give to water: HOH, WAT, TIP3, SOL and others.
bool is_water(absl::string_view residue);

// Returns true where the residue is one of the twenty amino acids or a plain nucleotide and cannot hold this element.
bool is_foreign(const Element& element, absl::string_view residue);

// How the name of an atom stands in its four columns of a PDB file, which may tell where the symbol of the element
// ends.
enum class NameColumns {
  // The symbol ends in the second column: "CA  " is calcium, " CA " an alpha carbon.
  kRightJustified,
  // Every name begins in the first column, so that the columns tell nothing about the symbol.
  kLeftJustified,
};

// Returns the element of an atom for which the file states none, by its name and residue, or null where it stays
// unknown. A right-justified name is given with the blanks of its four columns. Amino acids and nucleotides hold light
// elements only, and an ion has the name of its residue. Any other name that may mean a metal or a light atom of a
// ligand ("CD", "NA", "HG") means the light one.
const Element* element_of_name(absl::string_view name, absl::string_view residue, NameColumns columns);

// Returns the element of the label of an atom in an XYZ file, or null where it stays unknown. A label is a symbol in
// any case, an atomic number, an isotope ("13C", "2H"), an ion ("Fe3+") or a symbol with a number or other suffix
// ("C12", "Fe_2"). A label in capitals with a suffix that may mean a metal or a light atom ("CA1") means the light one.
const Element* element_of_label(absl::string_view label);

// Returns the element of an atom type of a force field. The name is read like a label, but capitals without a suffix
// ("CA", "HO", "OW") mean the light element too.
const Element* element_of_force_field_name(absl::string_view name);

}  // namespace isofield
