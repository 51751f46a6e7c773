// What blends with an individual range for every operand ([H]) know of one operand.
#pragma once

#include <compare>
#include <vector>

#include "operators/kind.h"

namespace isofield::operators {

struct Term {
  double range = 1;   // r_i
  double power = 2;   // p_i
  double weight = 1;  // m_i
  auto operator<=>(const Term&) const = default;
};

// Of an operator's terms, one for each operand or one for all, that of this operand.
inline const Term& term_of(const std::vector<Term>& terms, std::size_t operand) {
  return terms[terms.size() == 1 ? 0 : operand];
}

}  // namespace isofield::operators
