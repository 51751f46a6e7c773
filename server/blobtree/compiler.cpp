#include "blobtree/compiler.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <map>

#include "blobtree/leaf_placer.h"
#include "operators/profile_table.h"

namespace isofield::blobtree {
namespace {

Operator operator_of(const Node& node) {
  switch (node.kind) {
    case NodeKind::kSum:
      return Operator::kSum;
    case NodeKind::kMax:
      return Operator::kMax;
    case NodeKind::kMin:
      return Operator::kMin;
    case NodeKind::kDifference:
      return Operator::kSubtract;
    case NodeKind::kRicci:
      return Operator::kRicci;
    default:
      return node.silhouette.kind == operators::Silhouette::Kind::kSmooth ? Operator::kGradient
                                                                          : Operator::kGradientTable;
  }
}

// The same operator with its operands exchanged.
Operator exchanged(Operator op) {
  return op == Operator::kSubtract ? Operator::kSubtractFrom : op;
}

class Compiler {
 public:
  explicit Compiler(const Scene& scene) : scene_(scene) {}

  absl::StatusOr<Tape> run() {
    measure_depths();
    if (depth_[scene_.root] > kMaxStackDepth) {
      return absl::InvalidArgumentError(absl::StrCat(
          scene_.nodes[scene_.root].path, ": ", depth_[scene_.root], " operands would wait at once, expected at most ",
          kMaxStackDepth, "; write the deep children of operators with three and more children first"));
    }
    tape_.stack_depth = depth_[scene_.root];
    if (absl::Status s = emit_all(); !s.ok()) return s;
    return std::move(tape_);
  }

 private:
  // One node on the way of being emitted.
  struct Frame {
    std::uint32_t node;
    std::uint32_t to_world;  // in maps_
    std::uint32_t next_child = 0;
    bool second_first = false;    // the second child is deeper: it goes first
    std::uint32_t operation = 0;  // operators of two or more children
    // How the node's value joins what is on the stack when it is complete.
    Operator join = Operator::kPush;
    std::uint32_t join_operation = 0;
    double length = 0;  // largest range below
    Box support;
  };

  // Values that wait while a node is evaluated. A leaf-like operand is fused and never waits.
  void measure_depths() {
    depth_.assign(scene_.nodes.size(), 0);
    leaf_like_.assign(scene_.nodes.size(), 0);
    for (const std::uint32_t index : scene_.order) {
      const Node& node = scene_.nodes[index];
      leaf_like_[index] =
          node.kind == NodeKind::kPrimitive || (node.children.size() == 1 && leaf_like_[node.children[0]]);
      std::uint32_t need = 0;
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        const std::uint32_t child = ordered_child(node, i);
        const std::uint32_t waiting = i > 0 && !leaf_like_[child] ? 1 : 0;
        need = std::max(need, depth_[child] + waiting);
      }
      depth_[index] = need;
    }
  }

  bool second_goes_first(const Node& node) const {
    if (node.children.size() < 2) return false;
    const std::uint32_t first = node.children[0], second = node.children[1];
    return leaf_like_[first] ? !leaf_like_[second] : !leaf_like_[second] && depth_[second] > depth_[first];
  }
  std::uint32_t ordered_child(const Node& node, std::size_t i) const {
    return i < 2 && second_goes_first(node) ? node.children[1 - i] : node.children[i];
  }

  void open(std::uint32_t node, std::uint32_t to_world, Operator join, std::uint32_t join_operation) {
    Frame frame{.node = node, .to_world = to_world};
    frame.join = join;
    frame.join_operation = join_operation;
    const Node& n = scene_.nodes[node];
    frame.second_first = second_goes_first(n);
    if (n.children.size() >= 2) {
      frame.operation = static_cast<std::uint32_t>(tape_.operations.size());
      Operation& o = tape_.operations.emplace_back();
      o.op = operator_of(n);
      o.exponent = n.exponent;
      o.opening = n.opening;
      o.silhouette = n.silhouette;
      o.record = frame.operation;
      if (n.kind == NodeKind::kGradient) o.silhouette_bound = bound_of(n.silhouette);
    }
    if (n.kind == NodeKind::kTransform) {
      maps_.push_back(maps_[to_world].after(n.frame));
      frame.to_world = static_cast<std::uint32_t>(maps_.size() - 1);
    }
    stack_.push_back(frame);
  }

  double bound_of(const operators::Silhouette& silhouette) {
    const auto [known, is_new] = bounds_.try_emplace(silhouette);
    if (is_new) known->second = operators::silhouette_bound(silhouette);
    return known->second;
  }

  absl::Status emit_all() {
    maps_.emplace_back();
    open(scene_.root, 0, Operator::kPush, 0);
    while (!stack_.empty()) {
      Frame& top = stack_.back();
      const Node& node = scene_.nodes[top.node];
      if (node.kind == NodeKind::kPrimitive) {
        if (absl::Status s = emit_leaf(node, top); !s.ok()) return s;
        close();
        continue;
      }
      if (top.next_child == node.children.size()) {
        close();
        continue;
      }
      const std::uint32_t i = top.next_child++;
      const std::uint32_t child = ordered_child(node, i);
      if (node.children.size() == 1) {
        open(child, top.to_world, top.join, top.join_operation);
      } else if (i == 0) {
        open(child, top.to_world, Operator::kPush, 0);
      } else {
        const Operator op = operator_of(node);
        open(child, top.to_world, i == 1 && top.second_first ? exchanged(op) : op, top.operation);
      }
    }
    return absl::OkStatus();
  }

  absl::Status emit_leaf(const Node& node, Frame& frame) {
    absl::StatusOr<Leaf> leaf = place_leaf(node, maps_[frame.to_world]);
    if (!leaf.ok()) return leaf.status();
    leaf->record = tape_.leaf_records;
    leaf->node = frame.node;
    tape_.leaf_records += leaf_record_size(leaf->operand);
    emit(instruction(leaf->operand, frame.join, leaf->record, frame.join_operation,
                     static_cast<std::uint32_t>(tape_.leaves.size())));
    frame.length = leaf->range / leaf->stretch;
    frame.support = leaf->support;
    tape_.leaves.push_back(*std::move(leaf));
    return absl::OkStatus();
  }

  void emit(const Instruction& i) {
    tape_.code.push_back(i);
    tape_.operand_set |= 1u << static_cast<std::uint32_t>(i.operand());
    tape_.operator_set |= 1u << static_cast<std::uint32_t>(i.op());
    if (i.op() == Operator::kSubtract || i.op() == Operator::kSubtractFrom) {
      // Where the subtrahend is gone, the pruner clamps fields above 1 by subtracting 0.
      tape_.operand_set |= 1u << static_cast<std::uint32_t>(Operand::kZero);
      tape_.operator_set |= 1u << static_cast<std::uint32_t>(Operator::kSubtract);
    }
  }

  // The node on top is complete: join its value, and tell its parent what it needs to know.
  void close() {
    const Frame done = stack_.back();
    const Node& node = scene_.nodes[done.node];
    stack_.pop_back();
    if (node.kind == NodeKind::kTransform) maps_.pop_back();
    if (node.children.size() >= 2) {
      tape_.operations[done.operation].length = done.length;
      // A single child, or a leaf, has joined already.
      if (done.join != Operator::kPush) {
        emit(instruction(Operand::kPop, done.join, 0, done.join_operation));
      }
    }
    if (stack_.empty()) {
      tape_.support = done.support;
      return;
    }
    Frame& parent = stack_.back();
    const Node& above = scene_.nodes[parent.node];
    parent.length = std::max(parent.length, done.length);
    const std::uint32_t place = parent.next_child - 1;  // in the order of emission
    if (above.kind == NodeKind::kDifference) {
      if (place == (parent.second_first ? 1u : 0u)) parent.support = done.support;  // the minuend
    } else if (above.kind == NodeKind::kMin && place > 0) {
      intersect(parent.support, done.support);
    } else {
      parent.support.add(done.support);
    }
  }

  static void intersect(Box& a, const Box& b) {
    a.min = {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)};
    a.max = {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)};
    if (a.empty()) a = {};
  }

  const Scene& scene_;
  Tape tape_;
  std::vector<std::uint32_t> depth_;
  std::vector<char> leaf_like_;
  std::vector<Frame> stack_;
  std::vector<Affine> maps_;
  std::map<operators::Silhouette, double> bounds_;
};

}  // namespace

void Box::add(const Box& other) {
  min = {std::min(min.x, other.min.x), std::min(min.y, other.min.y), std::min(min.z, other.min.z)};
  max = {std::max(max.x, other.max.x), std::max(max.y, other.max.y), std::max(max.z, other.max.z)};
}

absl::StatusOr<Tape> compile(const Scene& scene) {
  return Compiler(scene).run();
}

}  // namespace isofield::blobtree
