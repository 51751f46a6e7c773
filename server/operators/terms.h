// A Term is what a blend with an individual range for every operand ([H]) knows of one operand.
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

// Returns the term of this operand. An operator has one term for each operand, or one for all.
inline const Term& term_of(const std::vector<Term>& terms, std::size_t operand) {
  return terms[terms.size() == 1 ? 0 : operand];
}

}  // namespace isofield::operators
