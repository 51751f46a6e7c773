#include "operators/max.h"

#include "operators/operator.h"

namespace isofield::operators {

Max Max::read(const v1::Max&, base::FieldReader&) {
  return {};
}

Opcode Max::opcode(Law) const {
  return Opcode::kMax;
}

}  // namespace isofield::operators
