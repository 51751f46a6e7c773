// Where a field's gradient can be compared with another evaluation of it.
#pragma once

#include "reference/evaluator.h"

namespace isofield::test_support {

// The largest difference between the gradient at p and at 14 points around it, `offset` away along the axes and the
// diagonals. A crease (equal operands of max or min, a shape's medial surface or edge, the fold of a bulge) within
// `offset` shows as the jump of the gradient across it, and a strongly curved place as what it is: sensitive to an
// error of that size in the coordinates. An evaluation whose coordinates are off by up to `offset` can't do better.
double gradient_variation(const reference::Evaluator& evaluator, const blobtree::dvec3& p, double offset);

// The same of its direction: the largest angle, in radians. Where operands are equal over an area, the slope of a blend
// may jump and its direction not.
double direction_variation(const reference::Evaluator& evaluator, const blobtree::dvec3& p, double offset);

}  // namespace isofield::test_support
