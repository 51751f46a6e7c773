#include "operators/min.h"

#include "operators/operator.h"

namespace isofield::operators {

Min Min::read(const v1::Min&, base::FieldReader&) {
  return {};
}

Opcode Min::opcode(Law) const {
  return Opcode::kMin;
}

}  // namespace isofield::operators
