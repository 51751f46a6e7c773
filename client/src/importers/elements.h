// The chemical elements and their van der Waals radii.
#pragma once

#include <absl/strings/string_view.h>

#include <optional>

namespace isofield {

// An element with its van der Waals radius in angstrom. Source: A. Bondi, "van der Waals Volumes and Radii", J. Phys.
// Chem. 68 (1964); for main group elements that it lacks, M. Mantina et al., J. Phys. Chem. A 113 (2009).
struct Element {
  absl::string_view symbol;
  // The radius is 0 where neither paper has one.
  double radius;
};

// The radius, in angstrom, of atoms whose element is unknown or has no radius.
inline constexpr double kUnknownElementRadius = 2.0;

// Returns the element of a symbol in any case; D and T (deuterium and tritium) are H. Null: there is no such element.
const Element* find_element(absl::string_view symbol);
// Returns the element of an atomic number, from 1. Null: there is no such element.
const Element* find_element(long long number);

}  // namespace isofield
