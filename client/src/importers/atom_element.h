#pragma once

#include <absl/strings/string_view.h>

#include "importers/elements.h"

namespace isofield {

// By the name of its residue, as the programs of the field write it: HOH, WAT, TIP3, SOL ...
bool is_water(absl::string_view residue);

// True where the residue is one of the twenty amino acids or a plain nucleotide and cannot hold this element.
bool is_foreign(const Element& element, absl::string_view residue);

// How far the columns of an atom name in a PDB file say where its symbol ends.
enum class NameColumns {
  // The symbol ends in the second column: "CA  " is calcium, " CA " an alpha carbon.
  kRightJustified,
  // Every name begins in the first column.
  kLeftJustified,
};

// The element of an atom of which the file states none, by its name and residue. A name has its four columns where
// they are right-justified. Amino acids and nucleotides hold light elements only; an ion has its residue's name; what
// else may mean a metal or a light atom of a ligand ("CD", "NA", "HG") is the light one. Null: unknown.
const Element* element_of_name(absl::string_view name, absl::string_view residue, NameColumns columns);

// The element of an atom's label in an XYZ file: a symbol in any case, an atomic number, an isotope ("13C", "2H"), an
// ion ("Fe3+") or a symbol with a number or other suffix ("C12", "Fe_2"). A label in capitals with a suffix that may
// mean a metal or a light atom ("CA1") is the light one. Null: unknown.
const Element* element_of_label(absl::string_view label);

// The same of a name of a force field's atom: as above, and without a suffix too ("CA", "HO", "OW").
const Element* element_of_force_field_name(absl::string_view name);

}  // namespace isofield
