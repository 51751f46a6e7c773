#include "reference/evaluator.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace isofield::reference {
namespace {

using blobtree::Affine;
using blobtree::dvec3;
using blobtree::Node;
using blobtree::NodeKind;

Primitive place(const blobtree::Primitive& p, const Affine& to_world) {
  const Affine frame = to_world.after(p.frame);
  // The reader refuses singular transforms, but a product of many may still underflow. Such a primitive is nowhere.
  const std::optional<Affine> inverse = frame.inverse(), own = p.frame.inverse();
  if (!inverse || !own) return {p.shape, 0, p.law, Affine::scale({}), {}, {}};
  return {p.shape, p.range, p.law, {inverse->linear, {}}, frame.offset, {own->linear, {}}};
}

}  // namespace

Evaluator::Evaluator(const blobtree::Scene& scene) : nodes_(scene.nodes) {
  // A node on the way from the root. The walk keeps a stack of its own, since a tree may be far deeper than the call
  // stack allows.
  struct Visit {
    std::uint32_t node;
    Affine to_world;
    std::size_t next_child = 0;
    double length = 0;
  };
  std::vector<Visit> stack{{scene.root, {}}};
  while (!stack.empty()) {
    Visit& top = stack.back();
    const Node& node = nodes_[top.node];
    if (top.next_child < node.children.size()) {
      const std::uint32_t child = node.children[top.next_child++];
      stack.push_back({child, node.kind == NodeKind::kTransform ? top.to_world.after(node.frame) : top.to_world});
      continue;
    }
    Step step{.node = top.node, .children = static_cast<std::uint32_t>(node.children.size())};
    if (node.kind == NodeKind::kPrimitive) {
      step.primitive = static_cast<std::uint32_t>(primitives_.size());
      primitives_.push_back(place(node.primitive, top.to_world));
      top.length = node.primitive.range;
    }
    if (node.kind == NodeKind::kSoften) top.length = node.range;
    if (node.kind == NodeKind::kTransform) {
      // A range counts along the direction in which the transform shrinks most.
      top.length *= node.frame.stretch().least;
      step.transform = static_cast<std::uint32_t>(inverses_.size());
      inverses_.push_back(node.frame.inverse().value_or(Affine::scale({})));
    }
    step.length = top.length;
    steps_.push_back(step);
    stack.pop_back();
    if (!stack.empty()) stack.back().length = std::max(stack.back().length, step.length);
  }
}

FieldState Evaluator::state(const dvec3& point) const {
  // The device clamps coordinates in the same way, since the squares of larger ones would overflow.
  static constexpr double kFarthest = 1e10;
  const auto near = [](double x) { return std::clamp(x, -kFarthest, kFarthest); };
  const dvec3 p{near(point.x), near(point.y), near(point.z)};
  std::vector<FieldState> stack;
  for (const Step& step : steps_) {
    const Node& node = nodes_[step.node];
    if (node.kind == NodeKind::kPrimitive) {
      stack.push_back(evaluate_primitive(primitives_[step.primitive], p));
      continue;
    }
    const std::size_t first = stack.size() - step.children;
    if (node.kind == NodeKind::kSoften) {
      stack[first] = soften(stack[first], node.range);
    } else if (node.kind == NodeKind::kHarden) {
      stack[first] = harden(stack[first]);
    } else if (node.kind == NodeKind::kTransform) {
      stack[first] = placed(stack[first], inverses_[step.transform]);
    } else if (step.children > 1) {
      const OperatorUse use{node.op.get(), node.law, step.length};
      stack[first] = combine(use, {stack.begin() + static_cast<std::ptrdiff_t>(first), stack.end()});
      stack.resize(first + 1);
    }
  }
  return stack.back();
}

Sample Evaluator::evaluate(const dvec3& p) const {
  const FieldState s = state(p);
  return {s.field.v, s.field.d};
}

}  // namespace isofield::reference
