#include "importers/elements.h"

#include <absl/strings/match.h>

#include <array>

namespace isofield {
namespace {

// The elements in the order of their atomic numbers.
constexpr std::array<Element, 118> kElements = {
    {{"H", 1.20},  {"He", 1.40}, {"Li", 1.82}, {"Be", 1.53}, {"B", 1.92},  {"C", 1.70},  {"N", 1.55},  {"O", 1.52},
     {"F", 1.47},  {"Ne", 1.54}, {"Na", 2.27}, {"Mg", 1.73}, {"Al", 1.84}, {"Si", 2.10}, {"P", 1.80},  {"S", 1.80},
     {"Cl", 1.75}, {"Ar", 1.88}, {"K", 2.75},  {"Ca", 2.31}, {"Sc", 0},    {"Ti", 0},    {"V", 0},     {"Cr", 0},
     {"Mn", 0},    {"Fe", 0},    {"Co", 0},    {"Ni", 1.63}, {"Cu", 1.40}, {"Zn", 1.39}, {"Ga", 1.87}, {"Ge", 2.11},
     {"As", 1.85}, {"Se", 1.90}, {"Br", 1.85}, {"Kr", 2.02}, {"Rb", 3.03}, {"Sr", 2.49}, {"Y", 0},     {"Zr", 0},
     {"Nb", 0},    {"Mo", 0},    {"Tc", 0},    {"Ru", 0},    {"Rh", 0},    {"Pd", 1.63}, {"Ag", 1.72}, {"Cd", 1.58},
     {"In", 1.93}, {"Sn", 2.17}, {"Sb", 2.06}, {"Te", 2.06}, {"I", 1.98},  {"Xe", 2.16}, {"Cs", 3.43}, {"Ba", 2.68},
     {"La", 0},    {"Ce", 0},    {"Pr", 0},    {"Nd", 0},    {"Pm", 0},    {"Sm", 0},    {"Eu", 0},    {"Gd", 0},
     {"Tb", 0},    {"Dy", 0},    {"Ho", 0},    {"Er", 0},    {"Tm", 0},    {"Yb", 0},    {"Lu", 0},    {"Hf", 0},
     {"Ta", 0},    {"W", 0},     {"Re", 0},    {"Os", 0},    {"Ir", 0},    {"Pt", 1.72}, {"Au", 1.66}, {"Hg", 1.55},
     {"Tl", 1.96}, {"Pb", 2.02}, {"Bi", 2.07}, {"Po", 1.97}, {"At", 2.02}, {"Rn", 2.20}, {"Fr", 3.48}, {"Ra", 2.83},
     {"Ac", 0},    {"Th", 0},    {"Pa", 0},    {"U", 1.86},  {"Np", 0},    {"Pu", 0},    {"Am", 0},    {"Cm", 0},
     {"Bk", 0},    {"Cf", 0},    {"Es", 0},    {"Fm", 0},    {"Md", 0},    {"No", 0},    {"Lr", 0},    {"Rf", 0},
     {"Db", 0},    {"Sg", 0},    {"Bh", 0},    {"Hs", 0},    {"Mt", 0},    {"Ds", 0},    {"Rg", 0},    {"Cn", 0},
     {"Nh", 0},    {"Fl", 0},    {"Mc", 0},    {"Lv", 0},    {"Ts", 0},    {"Og", 0}}};

}  // namespace

const Element* find_element(absl::string_view symbol) {
  if (absl::EqualsIgnoreCase(symbol, "D") || absl::EqualsIgnoreCase(symbol, "T")) symbol = "H";
  for (const Element& element : kElements) {
    if (absl::EqualsIgnoreCase(element.symbol, symbol)) return &element;
  }
  return nullptr;
}

const Element* find_element(long long number) {
  return number >= 1 && number <= static_cast<long long>(kElements.size()) ? &kElements[number - 1] : nullptr;
}

}  // namespace isofield
