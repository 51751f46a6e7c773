// Measures how fast a field's gradient changes near a point, so that tests compare two evaluations of a gradient only
// where they can agree.
#pragma once

#include "reference/evaluator.h"

namespace isofield::test_support {

// The largest difference between the gradient at p and at 14 points around it, `offset` away along the axes and the
// diagonals. A crease (equal operands of max or min, a shape's medial surface or edge, the fold of a bulge) within
// `offset` shows as the jump of the gradient across it. A strongly curved place shows as sensitive to an error of that
// size in the coordinates. An evaluation whose coordinates are off by up to `offset` can't do better.
double gradient_variation(const reference::Evaluator& evaluator, const blobtree::dvec3& p, double offset);

// The largest angle, in radians, between the same gradients. Where operands are equal over an area, the slope of a
// blend may jump while its direction does not.
double direction_variation(const reference::Evaluator& evaluator, const blobtree::dvec3& p, double offset);

}  // namespace isofield::test_support
