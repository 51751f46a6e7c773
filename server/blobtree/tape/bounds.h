// Bounds tells where a node's field matters: the support of a positive field, or the solid of a signed field and how
// fast it can grow.
#pragma once

#include <cstddef>
#include <limits>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

struct Bounds {
  // For a positive field, the box holds every point where the field is not 0. For a signed field, it holds every point
  // where the field is at most 0.
  Box box;
  // For a signed field and 0 <= r < limit, the box grown by r times `growth` holds every point where the field is at
  // most r. At the limit and beyond nothing is known.
  double growth = 0;
  double limit = std::numeric_limits<double>::infinity();

  // Returns a box that holds every point where the signed field is at most r.
  Box within(double r) const;
};

// Makes bounds of an operator's result, operand by operand in the order of the children. `so_far` has the bounds from
// the operands before, and `next` those of this operand.
void join_bounds(Bounds& so_far, const operators::Operator& op, operators::Law law, std::size_t operand,
                 const Bounds& next);

// These functions return the bounds after a conversion between the laws.
Bounds softened(const Bounds& signed_bounds, double range);
Bounds hardened(const Bounds& positive_bounds);

}  // namespace isofield::blobtree
