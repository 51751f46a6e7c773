#include "blobtree/tape/compiler.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "blobtree/tape/bounds.h"
#include "blobtree/tape/operation.h"

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Law;

bool is_joint(const Node& node) {
  return node.op && node.op->is_joint();
}
bool is_conversion(const Node& node) {
  return node.kind == NodeKind::kSoften || node.kind == NodeKind::kHarden;
}
// Returns whether a node has the value of its only child: transforms are folded into the leaves, and an operator leaves
// a single child as it is.
bool is_transparent(const Node& node) {
  return node.children.size() == 1 && !is_conversion(node);
}

// A transform this close to a similarity changes angles by no more than float32 does. An example is a rotation whose
// matrix was written with seven digits.
constexpr double kSimilar = 5e-7;

// The weights of nested blends may multiply fields and their gradients by this much in all.
constexpr double kMostGain = 1e9;

// Returns the most that an operator multiplies one of its operands by, which is 1 over the operand's weight.
double gain_of(const operators::Operator& op, std::size_t operands) {
  double gain = 1;
  for (std::size_t i = 0; i < operands; ++i) gain = std::max(gain, 1 / op.weight(i));
  return gain;
}

// Compiler makes one tape. It walks the scene with a stack of its own.
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
    has_frames_ = changes_angles();
    if (absl::Status s = emit_all(); !s.ok()) return s;
    return std::move(tape_);
  }

 private:
  // A Join says which operator takes a value, and how.
  struct Join {
    Opcode op = Opcode::kPush;
    std::uint32_t operation = 0;  // index in Tape::operations
    Mode mode;
  };
  // A Frame is a node that is being emitted.
  struct Frame {
    std::uint32_t node;
    std::uint32_t to_world;  // index in maps_
    std::uint32_t next_child = 0;
    bool second_first = false;    // the second child is deeper and goes first
    std::uint32_t operation = 0;  // for conversions and operators of two or more children
    // Says how the node's value joins what is on the stack when it is complete.
    Join join;
    double length = 0;  // largest range below, in the unit of the node's own frame
    double gain = 1;    // gain of the weights below
    Bounds bounds;
    Bounds waiting;  // if second_first: bounds of the second operand, until the first is there
  };

  // Counts the values that wait while a node is evaluated. A leaf-like operand is fused and never waits.
  void measure_depths() {
    depth_.assign(scene_.nodes.size(), 0);
    leaf_like_.assign(scene_.nodes.size(), 0);
    for (const std::uint32_t index : scene_.order) {
      const Node& node = scene_.nodes[index];
      leaf_like_[index] = node.kind == NodeKind::kPrimitive || (is_transparent(node) && leaf_like_[node.children[0]]);
      std::size_t need = 0;
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        const std::uint32_t child = ordered_child(node, i);
        const std::size_t waiting = is_joint(node) ? i : i > 0 && !leaf_like_[child] ? 1 : 0;
        need = std::max(need, depth_[child] + waiting);
      }
      depth_[index] = static_cast<std::uint32_t>(need);
    }
  }

  // Returns whether a transform that changes angles stands above some operator that follows an angle.
  bool changes_angles() const {
    std::vector<char> follows(scene_.nodes.size(), 0);
    for (const std::uint32_t index : scene_.order) {
      const Node& node = scene_.nodes[index];
      follows[index] = node.op && node.op->follows_angle() && node.children.size() > 1;
      for (const std::uint32_t child : node.children) follows[index] |= follows[child];
      if (node.kind == NodeKind::kTransform && follows[index] && !node.frame.is_similarity(kSimilar)) return true;
    }
    return false;
  }

  bool second_goes_first(const Node& node) const {
    if (node.children.size() < 2 || is_joint(node)) return false;
    const std::uint32_t first = node.children[0], second = node.children[1];
    return leaf_like_[first] ? !leaf_like_[second] : !leaf_like_[second] && depth_[second] > depth_[first];
  }
  std::uint32_t ordered_child(const Node& node, std::size_t i) const {
    return i < 2 && second_goes_first(node) ? node.children[1 - i] : node.children[i];
  }

  void open(std::uint32_t node, std::uint32_t to_world, const Join& join) {
    Frame frame{.node = node, .to_world = to_world};
    frame.join = join;
    const Node& n = scene_.nodes[node];
    frame.second_first = second_goes_first(n);
    if (n.children.size() >= 2 || is_conversion(n)) frame.operation = add_operation(n, node, maps_[to_world]);
    if (n.kind == NodeKind::kTransform) {
      maps_.push_back(maps_[to_world].after(n.frame));
      frame.to_world = static_cast<std::uint32_t>(maps_.size() - 1);
    }
    stack_.push_back(frame);
  }

  std::uint32_t add_operation(const Node& node, std::uint32_t index, const Affine& to_world) {
    Operation o;
    if (node.kind == NodeKind::kSoften) {
      o.op = Opcode::kSoften;
      o.range = node.range;
    } else if (node.kind == NodeKind::kHarden) {
      o.op = Opcode::kLinear;
      o.factor = -1;
      o.offset = 0.5;
    } else {
      o = operation_of(node.op, node.law, static_cast<std::uint32_t>(node.children.size()), silhouettes_);
      tape_.arity = std::max(tape_.arity, o.operands);
      if (has_frames_ && node.op->follows_angle()) o.frame = to_world.gradient_frame();
    }
    o.node = index;
    return blobtree::add_operation(tape_, std::move(o));
  }

  // Returns how the operand that is emitted as the i-th joins those before it.
  Join join_of(const Node& node, const Frame& frame, std::uint32_t i) const {
    Join join{tape_.operations[frame.operation].op, frame.operation, {}};
    const bool exchanged = i == 1 && frame.second_first;
    if (join.op == Opcode::kSubtract) {
      if (exchanged) join.op = Opcode::kSubtractFrom;
      return join;
    }
    join.mode.form = node.op->form;
    join.mode.is_signed = node.law == Law::kSigned;
    join.mode.is_exchanged = exchanged && node.op->is_ordered();
    return join;
  }

  absl::Status emit_all() {
    maps_.emplace_back();
    open(scene_.root, 0, {});
    while (!stack_.empty()) {
      Frame& top = stack_.back();
      const Node& node = scene_.nodes[top.node];
      if (node.kind == NodeKind::kPrimitive) {
        if (absl::Status s = emit_leaf(node, top); !s.ok()) return s;
        close();
        continue;
      }
      if (top.next_child == node.children.size()) {
        if (absl::Status s = check_gain(node, top); !s.ok()) return s;
        close();
        continue;
      }
      const std::uint32_t i = top.next_child++;
      const std::uint32_t child = ordered_child(node, i);
      if (is_transparent(node)) {
        open(child, top.to_world, top.join);
      } else if (i == 0 || is_joint(node)) {
        open(child, top.to_world, {});
      } else {
        open(child, top.to_world, join_of(node, top, i));
      }
    }
    return absl::OkStatus();
  }

  absl::Status emit_leaf(const Node& node, Frame& frame) {
    absl::StatusOr<Leaf> leaf = place_leaf(node.primitive, maps_[frame.to_world], node.path);
    if (!leaf.ok()) return leaf.status();
    leaf->record = tape_.leaf_records;
    leaf->node = frame.node;
    tape_.leaf_records += record_size(leaf->operand);
    emit(leaf->operand, frame.join, leaf->record, static_cast<std::uint32_t>(tape_.leaves.size()));
    if (leaf->law == Law::kSigned) tape_.codes.flags |= Codes::kSignedLeaves;
    frame.length = node.primitive.range;
    frame.bounds = {leaf->support, leaf->growth};
    tape_.leaves.push_back(*std::move(leaf));
    return absl::OkStatus();
  }

  void emit(Operand operand, const Join& join, std::uint32_t leaf = 0, std::uint32_t index = 0) {
    const std::uint32_t record = join.op == Opcode::kPush ? 0 : tape_.operations[join.operation].record;
    const Instruction i = instruction(operand, join.op, leaf, record, index, join.mode);
    tape_.code.push_back(i);
    tape_.codes.operands.add(operand);
    tape_.codes.opcodes.add(join.op);
    if (join.op != Opcode::kPush) add_codes(tape_, tape_.operations[join.operation], join.mode);
  }

  // Refuses nested blends that divide fields by so small weights that float32 would not hold the results.
  static absl::Status check_gain(const Node& node, Frame& frame) {
    if (node.kind == NodeKind::kSoften) frame.gain = 1;
    if (node.op && node.children.size() >= 2) frame.gain *= gain_of(*node.op, node.children.size());
    if (frame.gain <= kMostGain) return absl::OkStatus();
    return absl::InvalidArgumentError(
        absl::StrCat(node.path, ": its weights and those of blends below divide a field by ", 1 / frame.gain,
                     " in all: expected weights whose product along a way down is at least ", 1 / kMostGain));
  }

  // Completes the node on top of the stack: joins its value, and tells its parent what it needs to know.
  void close() {
    Frame done = stack_.back();
    const Node& node = scene_.nodes[done.node];
    stack_.pop_back();
    if (node.kind == NodeKind::kTransform) {
      maps_.pop_back();
      done.length *= node.frame.stretch().least;
    }
    if (node.children.size() >= 2 || is_conversion(node)) {
      const Join own{tape_.operations[done.operation].op, done.operation, unary_mode(node)};
      if (node.kind == NodeKind::kSoften) done.length = node.range;
      if (is_conversion(node)) {
        done.bounds = node.kind == NodeKind::kSoften ? softened(done.bounds, node.range) : hardened(done.bounds);
        emit(Operand::kZero, own);
      } else if (is_joint(node)) {
        emit(Operand::kZero, own, (1u << node.children.size()) - 1);
      }
      Operation& operation = tape_.operations[done.operation];
      // Without frames all maps above are similarities, which scale equally in all directions.
      if (operation.what && operation.what->follows_angle()) {
        operation.length = done.length * (operation.frame ? 1 : maps_[done.to_world].stretch().most);
      }
      // A transparent node's child, or a leaf, has joined already.
      if (done.join.op != Opcode::kPush) emit(Operand::kPop, done.join);
    }
    if (stack_.empty()) {
      tape_.law = node.law;
      tape_.support = done.bounds.box;
      return;
    }
    Frame& parent = stack_.back();
    const Node& above = scene_.nodes[parent.node];
    parent.length = std::max(parent.length, done.length);
    parent.gain = std::max(parent.gain, done.gain);
    if (!above.op || above.children.size() == 1) {
      parent.bounds = done.bounds;
      return;
    }
    // The order of emission may exchange the first two operands.
    std::uint32_t operand = parent.next_child - 1;
    if (parent.second_first && operand < 2) {
      if (operand == 0) {
        parent.waiting = done.bounds;
        return;
      }
      join_bounds(parent.bounds, *above.op, above.law, 0, done.bounds);
      join_bounds(parent.bounds, *above.op, above.law, 1, parent.waiting);
      return;
    }
    join_bounds(parent.bounds, *above.op, above.law, operand, done.bounds);
  }

  static Mode unary_mode(const Node& node) {
    if (!is_joint(node)) return {};
    return {node.op->form, node.law == Law::kSigned, false};
  }

  const Scene& scene_;
  Tape tape_;
  std::vector<std::uint32_t> depth_;
  std::vector<char> leaf_like_;
  std::vector<Frame> stack_;
  std::vector<Affine> maps_;
  bool has_frames_ = false;
  operators::SilhouetteBounds silhouettes_;
};

}  // namespace

std::pair<double, double> Tape::linear(const Instruction& i) const {
  const Operation& o = operation(i);
  if (o.op == Opcode::kLinear) return {o.factor, o.offset};
  return {1 / o.what->weight(i.operation - o.record - 1), 0};
}

absl::StatusOr<Tape> compile(const Scene& scene) {
  return Compiler(scene).run();
}

}  // namespace isofield::blobtree
