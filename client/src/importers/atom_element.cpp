#include "importers/atom_element.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>

#include <algorithm>
#include <array>
#include <gemmi/resinfo.hpp>
#include <string>
#include <utility>

#include "importers/text.h"

namespace isofield {
namespace {

template <std::size_t count>
bool is_one_of(absl::string_view name, const std::array<absl::string_view, count>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string upper(absl::string_view text) {
  return absl::AsciiStrToUpper(absl::StripAsciiWhitespace(text));
}

// Returns the first run of letters in a name; digits and primes may stand before it.
absl::string_view leading_letters(absl::string_view name) {
  const auto letter = [](unsigned char c) { return absl::ascii_isalpha(c); };
  const auto begin = std::find_if(name.begin(), name.end(), letter);
  const auto end = std::find_if_not(begin, name.end(), letter);
  return name.substr(static_cast<std::size_t>(begin - name.begin()), static_cast<std::size_t>(end - begin));
}

gemmi::ResidueInfo residue_info(absl::string_view residue) {
  return gemmi::find_tabulated_residue(upper(residue));
}

bool is_polymer(const gemmi::ResidueInfo& info) {
  return info.is_amino_acid() || info.is_nucleic_acid();
}

// Symbols in capitals that begin like a light element, but are hardly ever a light atom with a suffix.
constexpr std::array<absl::string_view, 13> kHeavySymbols = {"CL", "CO", "CR", "CU", "NI", "PD", "PT",
                                                             "SC", "SE", "SI", "SM", "SN", "SR"};

// Names, in capitals, that programs give to points without an atom: dummies, ghosts and lone pairs.
constexpr std::array<absl::string_view, 5> kNoAtoms = {"BQ", "DU", "DUM", "LP", "XX"};

// Returns the lightest element that a name may mean, by its letters in capitals ("CA" is carbon), or null where there
// is none.
const Element* lightest(absl::string_view letters) {
  if (letters.empty() || is_one_of(letters, kNoAtoms)) return nullptr;
  const bool light = absl::string_view("CNOHSPD").find(letters[0]) != absl::string_view::npos;
  const absl::string_view two = letters.substr(0, 2);
  if (two.size() == 2 && (!light || is_one_of(two, kHeavySymbols))) {
    if (const Element* element = find_element(two)) return element;
  }
  return find_element(letters.substr(0, 1));
}

const Element* element_in_polymer(absl::string_view letters, const gemmi::ResidueInfo& info) {
  if (letters.empty()) return nullptr;
  if (absl::StartsWith(letters, "SE")) return find_element("SE");
  if (absl::string_view("CNOSPHD").find(letters[0]) != absl::string_view::npos) {
    return find_element(letters.substr(0, 1));
  }
  // Modified residues may hold other elements, such as the bromine in BRU.
  return info.is_standard() ? nullptr : lightest(letters);
}

// Returns the element of an ion, or null where the atom is no ion. An ion, which is the only atom of its residue, has
// the name of its residue: "CA" in "CA", "ZN" in "ZN2", "NA" in "NA+". The names that CHARMM gives to ions are known
// too.
const Element* element_of_ion(absl::string_view letters, absl::string_view residue) {
  constexpr std::array<std::pair<absl::string_view, absl::string_view>, 9> kCharmm = {{{"SOD", "NA"},
                                                                                       {"CLA", "CL"},
                                                                                       {"POT", "K"},
                                                                                       {"CAL", "CA"},
                                                                                       {"CES", "CS"},
                                                                                       {"LIT", "LI"},
                                                                                       {"RUB", "RB"},
                                                                                       {"BAR", "BA"},
                                                                                       {"CAD", "CD"}}};
  if (residue == "ION") return find_element(letters);
  if (letters != leading_letters(residue)) return nullptr;
  for (const auto& [name, symbol] : kCharmm) {
    if (letters == name) return find_element(symbol);
  }
  return find_element(letters);
}

// Returns the element of a name by its four columns, in capitals, as NameColumns::kRightJustified says.
const Element* element_of_columns(absl::string_view name, absl::string_view letters) {
  const bool full = !absl::ascii_isspace(static_cast<unsigned char>(name[3]));
  if (!full && absl::ascii_isalpha(static_cast<unsigned char>(name[0]))) {
    if (const Element* element = find_element(absl::StripAsciiWhitespace(name.substr(0, 2)))) return element;
  }
  return lightest(letters);
}

// Returns true for the charge of an ion, such as "+", "2-", "3+" or "+2".
bool is_charge(absl::string_view suffix) {
  return suffix.find_first_of("+-") != absl::string_view::npos &&
         suffix.find_first_not_of("+-0123456789") == absl::string_view::npos;
}

}  // namespace

bool is_water(absl::string_view residue) {
  constexpr std::array<absl::string_view, 24> kNames = {"HOH",  "WAT", "DOD", "D2O",  "H2O", "HHO",  "OHH",  "HH0",
                                                        "OH2",  "SOL", "SPC", "SPCE", "TIP", "TIP2", "TIP3", "TIP4",
                                                        "TIP5", "TP3", "TP4", "TP5",  "T3P", "T4P",  "T5P",  "WTR"};
  return residue.size() <= 5 && is_one_of(upper(residue.substr(0, 4)), kNames);
}

bool is_foreign(const Element& element, absl::string_view residue) {
  constexpr std::array<absl::string_view, 7> kLight = {"H", "C", "N", "O", "P", "S", "Se"};
  const gemmi::ResidueInfo info = residue_info(residue);
  return is_polymer(info) && info.is_standard() && !is_one_of(element.symbol, kLight);
}

const Element* element_of_name(absl::string_view name, absl::string_view residue, NameColumns columns) {
  const std::string capitals = absl::AsciiStrToUpper(name);
  const absl::string_view letters = leading_letters(capitals);
  if (is_water(residue)) {
    const bool known = !letters.empty() && absl::string_view("OHD").find(letters[0]) != absl::string_view::npos;
    return known ? find_element(letters.substr(0, 1)) : nullptr;
  }
  const gemmi::ResidueInfo info = residue_info(residue);
  if (is_polymer(info)) return element_in_polymer(letters, info);
  if (const Element* ion = element_of_ion(letters, upper(residue))) return ion;
  const bool has_columns = columns == NameColumns::kRightJustified && capitals.size() == 4;
  return has_columns ? element_of_columns(capitals, letters) : lightest(letters);
}

const Element* element_of_label(absl::string_view label) {
  if (const auto number = parse_integer(label)) return find_element(*number);
  const absl::string_view letters = leading_letters(label);
  if (letters.empty()) return nullptr;
  const absl::string_view suffix = label.substr(static_cast<std::size_t>(letters.end() - label.begin()));
  const bool is_symbol = letters.size() <= 2 && (suffix.empty() || is_charge(suffix));
  const bool mixed_case = letters.size() >= 2 && absl::ascii_isupper(static_cast<unsigned char>(letters[0])) &&
                          absl::ascii_islower(static_cast<unsigned char>(letters[1]));
  if (is_symbol || mixed_case) {
    if (const Element* element = find_element(letters.substr(0, 2))) return element;
  }
  return lightest(absl::AsciiStrToUpper(letters));
}

const Element* element_of_force_field_name(absl::string_view name) {
  const absl::string_view letters = leading_letters(name);
  const bool capitals =
      std::none_of(letters.begin(), letters.end(), [](unsigned char c) { return absl::ascii_islower(c); });
  const bool charged = name.find_first_of("+-") != absl::string_view::npos;
  return capitals && !charged ? lightest(letters) : element_of_label(name);
}

}  // namespace isofield
