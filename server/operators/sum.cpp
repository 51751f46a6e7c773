#include "operators/sum.h"

#include "operators/operator.h"

namespace isofield::operators {

Sum Sum::read(const v1::Sum&, base::FieldReader&) {
  return {};
}

Opcode Sum::opcode(Law) const {
  return Opcode::kSum;
}

}  // namespace isofield::operators
