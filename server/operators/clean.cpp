#include "operators/clean.h"

#include "operators/operator.h"

namespace isofield::operators {

Clean Clean::read(const v1::CleanUnion&, base::FieldReader&) {
  return {};
}

Opcode Clean::opcode(Law) const {
  return Opcode::kClean;
}

Interval Clean::bound(const Interval& a, const Interval& b) const {
  // Level curves are arcs, at most a quarter of a circle around the origin.
  return {std::max(a.lo, b.lo), std::hypot(a.hi, b.hi) + base::kValueRoom};
}

}  // namespace isofield::operators
