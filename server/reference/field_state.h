// Defines the state of a node of a Blob-tree at a point, and how primitives, operators, transforms and conversions
// compute it.
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
// vectors. A steering vector is the gradient, except that an operator that follows an angle leaves out the term of the
// angle itself: with this term, each further blend above would need one more derivative of everything below. The angle
// at a node is thus the one between the gradients if no operand contains such a blend, and close to it otherwise. The
// gradient of the result is the exact derivative of the field, to any depth.
struct FieldState {
  Dual field;
  DualVec3 steering;
};

// An operator as it is used at one place of the tree.
struct OperatorUse {
  const operators::Operator* op = nullptr;
  operators::Law law = operators::Law::kPositive;  // the law of the operands
  // Steered blends need the largest range among the primitives and conversions below, in the unit of the node's frame.
  // A steering vector counts as null where it is small compared with 1 / length.
  double length = 1;
  // It is set if the operands' derivatives are with respect to coordinates of the world, and is then
  // Affine::gradient_frame() of the map from the node's frame to the world, which gives the angles and lengths of
  // gradients in the node's frame. Otherwise the derivatives are with respect to coordinates of the node's frame.
  std::optional<blobtree::Affine::LowerTriangle> frame;
};

// A placed primitive. It is evaluated at the point q = to_local (p - anchor) of its shape's own frame, where p is a
// point of the world.
struct Primitive {
  blobtree::Shape shape;
  double range = 0;  // for positive fields
  operators::Law law = operators::Law::kPositive;
  blobtree::Affine to_local;  // linear part only
  blobtree::dvec3 anchor;
  blobtree::Affine to_shape;  // linear part only: from the node's frame, in which derivatives are, to the shape's
};

FieldState evaluate_primitive(const Primitive& primitive, const blobtree::dvec3& p);

// Applies an operator to at least two operands, whose order matters.
FieldState combine(const OperatorUse& use, const std::vector<FieldState>& operands);

// Returns the state of a transform node, given that of its child. Derivatives go through `inverse`, the inverse of the
// transform's map.
FieldState placed(const FieldState& child, const blobtree::Affine& inverse);

// Convert a signed field to a positive one that falls off to 0 within `range`, and a positive field to a signed one.
FieldState soften(const FieldState& signed_field, double range);
FieldState harden(const FieldState& positive_field);

}  // namespace isofield::reference
