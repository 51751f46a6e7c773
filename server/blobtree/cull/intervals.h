// Bounds of operators over intervals of their operands: what culling decides with.
#pragma once

#include <vector>

#include "base/interval.h"
#include "blobtree/tape/tape.h"
#include "operators/joint.h"

namespace isofield::blobtree {

using base::kValueRoom;

// 1 - i, or -i.
Interval complement(const Interval& i, bool is_signed);

// Of two operands in their order, in the form of `mode`. Bounds hold for the device's float32 results too.
Interval binary_interval(Opcode op, const Operation& o, const Mode& mode, Interval a, Interval b);

// Of an operator that takes all its operands at once, of those in `mask`, whose intervals come in their order.
Interval joint_interval(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> operands);

// Which of the operands in `mask` can make a difference to a joint operator of such operands.
std::uint32_t active_operands(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> operands);

// The operand, 0 or 1, that alone makes the result, over its weight; or -1 where both may. `a` and `b` as for
// binary_interval.
int lone_operand(const Operation& o, const Mode& mode, Interval a, Interval b);

}  // namespace isofield::blobtree
