#include "operators/difference.h"

#include <algorithm>

#include "operators/operator.h"

namespace isofield::operators {

Difference Difference::read(const v1::Difference&, base::FieldReader&) {
  return {};
}

Opcode Difference::opcode(Law law) const {
  return law == Law::kSigned ? Opcode::kMin : Opcode::kSubtract;
}

Interval Difference::bound(const Interval& a, const Interval& b) const {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}

Interval Difference::bound_positive(const Interval& a, const Interval& b) {
  return {std::max(std::min(a.lo, 1 - b.hi) - base::kValueRoom, 0.0), std::min(a.hi, 1 - b.lo)};
}

}  // namespace isofield::operators
