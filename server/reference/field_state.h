// What a node of a Blob-tree yields at a point, and how operators make one from two.
#pragma once

#include "blobtree/affine.h"
#include "blobtree/distance.h"
#include "blobtree/scene.h"
#include "reference/dual.h"

namespace isofield::reference {

// The field with its gradient, and the *steering vector* with its Jacobian (component i of `steering` carries the
// derivatives of that component). Opening functions measure angles between steering vectors. A steering vector is the
// gradient, except that a gradient-based blend leaves the term of theta out of its own: with it, every further blend
// above would need one more derivative of everything below. So the angle at a node is that between the gradients for
// operands without such a blend and close to it for the others, and the gradient that comes out is the exact
// derivative of the field, to any depth.
struct FieldState {
  Dual field;
  DualVec3 steering;
};

// The parameters of an operator, as they are used at one place of the tree.
struct OperatorUse {
  blobtree::NodeKind kind = blobtree::NodeKind::kSum;
  double exponent = 1;                                // kRicci
  const operators::Opening* opening = nullptr;        // kGradient
  const operators::Silhouette* silhouette = nullptr;  // kGradient
  // kGradient: the largest range among the primitives below, in the world's unit of length. A steering vector counts
  // as null where it is small against 1 / length.
  double length = 1;
};

// A primitive at the point q = to_local (p - anchor) of its own frame.
struct Primitive {
  blobtree::Shape shape = blobtree::Shape::kSphere;
  blobtree::ShapeSize size{};
  double range = 0;
  blobtree::Affine to_local;  // linear part only
  blobtree::dvec3 anchor;
};

FieldState evaluate_primitive(const Primitive& primitive, const blobtree::dvec3& p);

FieldState combine(const OperatorUse& use, const FieldState& a, const FieldState& b);

}  // namespace isofield::reference
