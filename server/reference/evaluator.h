// Evaluates a Blob-tree slowly and simply, in double precision. The tests compare the device with it. It walks the
// scene and not its tape, so that it checks the compiler as well as the device. Derivatives are kept in the own frame
// of each node: a transform T of a field f yields f(T^-1 p), whatever the nodes below are.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/scene/scene.h"
#include "reference/field_state.h"

namespace isofield::reference {

// The field at a point.
struct Sample {
  double value = 0;
  // The derivative of `value`. It is 0 where there is no derivative: at centres, axes and medial surfaces of shapes. If
  // the operands of max, min or difference are equal, it is that of the first operand.
  blobtree::dvec3 gradient;
};

// An evaluator does not change once it is constructed, so any number of threads may use it at once. Values and
// gradients are finite everywhere. To find out whether a point is close to a crease, use tests/support/smoothness.h,
// which compares the gradients around it.
class Evaluator {
 public:
  // Copies what it needs of `scene`. It takes memory in proportion to the number of nodes, where a shared node counts
  // once for each use.
  explicit Evaluator(const blobtree::Scene& scene);

  Sample evaluate(const blobtree::dvec3& p) const;
  double value(const blobtree::dvec3& p) const { return evaluate(p).value; }
  // Returns the field with its gradient, and the steering vector with its Jacobian.
  FieldState state(const blobtree::dvec3& p) const;

 private:
  // One use of a node. Steps lie in an order in which children come before their parents: the step of a primitive
  // pushes its state on a stack, and that of a node with k children replaces the last k states by one.
  struct Step {
    std::uint32_t node;
    std::uint32_t children = 0;
    std::uint32_t primitive = 0;  // index in primitives_
    std::uint32_t transform = 0;  // index in inverses_
    double length = 0;            // OperatorUse::length
  };

  std::vector<blobtree::Node> nodes_;
  std::vector<Step> steps_;
  std::vector<Primitive> primitives_;
  std::vector<blobtree::Affine> inverses_;
};

}  // namespace isofield::reference
