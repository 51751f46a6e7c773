// The slow, obvious evaluator of a Blob-tree in double precision: the oracle of the tests, and a debugging mode. It
// walks the scene itself, so that it checks the compiler as well as the device, and keeps every node's derivatives in
// the node's own frame: a transform of f yields f(T^-1 p), whatever stands below.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/scene/scene.h"
#include "reference/field_state.h"

namespace isofield::reference {

struct Sample {
  double value = 0;
  // The derivative of `value` (operators note, section 2.2). 0 where there is none: at centres, axes and medial
  // surfaces of shapes. Where operands of max, min or difference are equal, the first one's.
  blobtree::dvec3 gradient;
};

// Immutable once constructed: any number of threads may evaluate at once. Values and gradients are finite everywhere.
// Whether a point is close to a crease is told by tests/support/smoothness.h, from the gradients around it.
class Evaluator {
 public:
  // Copies what it needs of `scene`. Takes memory in proportion to the nodes with shared ones counted at every use.
  explicit Evaluator(const blobtree::Scene& scene);

  Sample evaluate(const blobtree::dvec3& p) const;
  double value(const blobtree::dvec3& p) const { return evaluate(p).value; }
  // With the steering vector and its Jacobian.
  FieldState state(const blobtree::dvec3& p) const;

 private:
  // One use of a node, after its children: a primitive pushes its state, an operator of k children folds the last k.
  struct Step {
    std::uint32_t node;
    std::uint32_t children = 0;
    std::uint32_t primitive = 0;  // in primitives_
    std::uint32_t transform = 0;  // in inverses_
    double length = 0;            // OperatorUse::length
  };

  std::vector<blobtree::Node> nodes_;
  std::vector<Step> steps_;
  std::vector<Primitive> primitives_;
  std::vector<blobtree::Affine> inverses_;
};

}  // namespace isofield::reference
