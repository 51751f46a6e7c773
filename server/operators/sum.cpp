#include "operators/sum.h"

#include "operators/operator.h"

namespace isofield::operators {

Sum Sum::read(const v1::Sum&, base::FieldReader&) {
  return {};
}

Opcode Sum::opcode(Law) const {
  return Opcode::kSum;
}

Interval Sum::bound(const Interval& a, const Interval& b) const {
  return {a.lo + b.lo, a.hi + b.hi};
}

}  // namespace isofield::operators
