// Bounds of operators over intervals of their operands: what culling decides with.
#pragma once

#include <vector>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

struct Interval {
  double lo = 0, hi = 0;
};

// What float32 evaluation may differ from exact arithmetic: of a value of size 1.
inline constexpr double kValueRoom = 4e-6;

// 1 - i, or -i.
Interval complement(const Interval& i, bool is_signed);

// Of two operands in their order, in the form of `mode`. Bounds hold for the device's float32 results too.
Interval binary_interval(Operator op, const Operation& o, const Mode& mode, Interval a, Interval b);

// Of kSuperelliptic and kBtk, of the operands in `mask`.
Interval n_ary_interval(Operator op, const Operation& o, const Mode& mode, std::uint32_t mask,
                        std::vector<Interval> operands);

// Which of the operands in `mask` can make a difference to a kBtk of such operands: the others are beyond its range
// wherever the operand that is left bounds the result.
std::uint32_t active_operands(const Operation& o, const Mode& mode, std::uint32_t mask,
                              const std::vector<Interval>& operands);

// The operand of a kBt2 or kFunctional, 0 or 1, that alone makes its result, or -1. `a` and `b` as for binary_interval.
int lone_operand(const Operation& o, const Mode& mode, Interval a, Interval b);

}  // namespace isofield::blobtree
