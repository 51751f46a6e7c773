// These functions bound the results of operators from intervals of their operands. Culling decides with them what is
// left of a tape in a box.
#pragma once

#include <vector>

#include "base/interval.h"
#include "blobtree/tape/tape.h"
#include "operators/joint.h"

namespace isofield::blobtree {

using base::kValueRoom;

// Returns the interval of 1 - i for positive fields, or of -i for signed ones.
Interval complement(const Interval& i, bool is_signed);

// Returns bounds of an operator of two operands. `a` is the left operand and `b` the right one; `mode` has the form,
// and says whether they are exchanged. The bounds hold for the device's float32 results, too.
Interval binary_interval(Opcode op, const Operation& o, const Mode& mode, Interval a, Interval b);

// Returns bounds of a joint operator, which is one that takes all its operands at once. `mask` has a bit for each
// operand that is left, and `operands` has their intervals in order.
Interval joint_interval(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> operands);

// Returns those of the operands in `mask` that can make a difference to the result of a joint operator.
std::uint32_t active_operands(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> operands);

// Returns which operand alone determines the result of an operator of two operands: 0 for the first, 1 for the second,
// or -1 if both may matter. The result is then that operand divided by its weight. `a` and `b` are as for
// binary_interval(). The fields must be signed.
int lone_operand(const Operation& o, const Mode& mode, Interval a, Interval b);

}  // namespace isofield::blobtree
