#include "operators/min.h"

#include <algorithm>

#include "operators/operator.h"

namespace isofield::operators {

Min Min::read(const v1::Min&, base::FieldReader&) {
  return {};
}

Opcode Min::opcode(Law) const {
  return Opcode::kMin;
}

Interval Min::bound(const Interval& a, const Interval& b) const {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}

}  // namespace isofield::operators
