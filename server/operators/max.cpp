#include "operators/max.h"

#include <algorithm>

#include "operators/operator.h"

namespace isofield::operators {

Max Max::read(const v1::Max&, base::FieldReader&) {
  return {};
}

Opcode Max::opcode(Law) const {
  return Opcode::kMax;
}

Interval Max::bound(const Interval& a, const Interval& b) const {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

}  // namespace isofield::operators
