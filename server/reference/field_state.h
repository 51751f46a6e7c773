// What a node of a Blob-tree yields at a point, and how operators make one from two.
#pragma once

#include <optional>
#include <vector>

#include "blobtree/geometry/affine.h"
#include "blobtree/primitives/primitive.h"
#include "operators/operator.h"
#include "reference/dual.h"

namespace isofield::reference {

// The field with its gradient, and the *steering vector* with its Jacobian (component i of `steering` carries the
// derivatives of that component). Opening functions and ranges that follow an angle measure it between steering
// vectors. A steering vector is the gradient, except that an operator that follows an angle leaves the angle's own term
// out of it: with it, every further blend above would need one more derivative of everything below. So the angle at a
// node is that between the gradients for operands without such a blend and close to it for the others, and the gradient
// that comes out is the exact derivative of the field, to any depth.
struct FieldState {
  Dual field;
  DualVec3 steering;
};

// An operator as it is used at one place of the tree.
struct OperatorUse {
  const operators::Operator* op = nullptr;
  operators::Law law = operators::Law::kPositive;  // of the operands
  // Steered blends: the largest range among the primitives and conversions below, in the unit of the node's frame. A
  // steering vector counts as null where it is small against 1 / length.
  double length = 1;
  // Set where the operands' derivatives are by coordinates of the world: Affine::gradient_frame() of the map from the
  // node's frame to the world, for the angles and lengths of gradients. Else they are by those of the node's frame.
  std::optional<blobtree::Affine::LowerTriangle> frame;
};

// A primitive at the point q = to_local (p - anchor) of the shape's own frame, where p is a point of the world.
struct Primitive {
  blobtree::Shape shape;
  double range = 0;  // positive
  operators::Law law = operators::Law::kPositive;
  blobtree::Affine to_local;  // linear part only
  blobtree::dvec3 anchor;
  blobtree::Affine to_shape;  // linear part only: from the node's frame, in which derivatives are, to the shape's
};

FieldState evaluate_primitive(const Primitive& primitive, const blobtree::dvec3& p);

// At least two operands, in order.
FieldState combine(const OperatorUse& use, const std::vector<FieldState>& operands);

// The state of a transform node from that of its child: derivatives go through the inverse of the transform's map.
FieldState placed(const FieldState& child, const blobtree::Affine& inverse);

// Conversions between the laws.
FieldState soften(const FieldState& signed_field, double range);
FieldState harden(const FieldState& positive_field);

}  // namespace isofield::reference
