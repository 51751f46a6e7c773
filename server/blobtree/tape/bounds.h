// Where a node's field matters: the support of a positive one, the solid of a signed one and how fast it can grow.
#pragma once

#include <cstddef>
#include <limits>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

struct Bounds {
  // Positive: holds every point where the field is not 0. Signed: where it is at most 0.
  Box box;
  // Signed: where the field is at most r, for 0 <= r < limit, the box grown by r times `growth` holds the point. At and
  // beyond the limit nothing is known.
  double growth = 0;
  double limit = std::numeric_limits<double>::infinity();

  // Signed: holds every point where the field is at most r.
  Box within(double r) const;
};

// Of an operator's result, operand by operand in the order of the children: `so_far` are those of the operands before.
void join_bounds(Bounds& so_far, const operators::Operator& op, operators::Law law, std::size_t operand,
                 const Bounds& next);

Bounds softened(const Bounds& signed_bounds, double range);
Bounds hardened(const Bounds& positive_bounds);

}  // namespace isofield::blobtree
