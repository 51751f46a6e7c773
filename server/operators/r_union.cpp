#include "operators/r_union.h"

#include "operators/operator.h"

namespace isofield::operators {

RUnion RUnion::read(const v1::RUnion&, base::FieldReader&) {
  return {};
}

Opcode RUnion::opcode(Law) const {
  return Opcode::kPasko;
}

}  // namespace isofield::operators
