#include "blobtree/cull/pruner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "blobtree/primitives/falloff.h"

namespace isofield::blobtree {
namespace {

Instruction with_operator(Instruction i, Opcode op) {
  i.code = (i.code & 0xff) | static_cast<std::uint32_t>(op) << 8;
  return i;
}
Instruction with_operand(Instruction i, Operand operand) {
  i.code = (i.code & ~0xffu) | static_cast<std::uint32_t>(operand);
  return i;
}

// kIsJoint tells whether each opcode, by its number, takes all of its operands at once.
constexpr auto kIsJoint = [] {
  std::array<bool, operators::kOpcodes.size()> is_joint{};
  for (std::size_t i = 0; i < is_joint.size(); ++i) {
    is_joint[i] = operators::kOpcodes[i].applies == operators::Applies::kMany;
  }
  return is_joint;
}();

bool is_joint(Opcode op) {
  return kIsJoint[static_cast<std::size_t>(op)];
}

}  // namespace

void Pruner::bound_leaf(const Leaf& leaf, const Box& box, const CentredBox& centred, Value& value) {
  const bool is_positive = leaf.law == operators::Law::kPositive;
  value.is_zero = is_positive && !leaf.support.touches(box);
  if (value.is_zero) return;
  value.range = field_bounds(leaf, centred);
  value.is_zero = is_positive && value.range.hi <= 0;
}

void Pruner::join(const Instruction& i, const Value& right, bool fused, std::vector<Instruction>& out) {
  const Opcode op = i.op();
  const Mode mode = i.mode();
  Value& left = stack_.back();
  const auto keep_right = [&] {
    out.erase(out.begin() + left.begin, out.begin() + right.begin);
    if (fused) out.push_back(with_operator(i, Opcode::kPush));
    left.range = right.range;
    left.is_zero = false;
  };
  const auto keep_left = [&] { out.resize(right.begin); };
  const auto vanish = [&] {
    out.resize(left.begin);
    left.range = {0, 0};
    left.is_zero = true;
  };
  // f - 0 = min(f, 1), and only sums and blends are above 1.
  const auto clamp = [&] {
    if (left.range.hi <= 1 + 2 * kValueRoom) return;
    out.push_back(with_operator(with_operand(i, Operand::kZero), Opcode::kSubtract));
    left.range = {std::min(left.range.lo, 1.0), 1 + kValueRoom};
  };
  const bool left_zero = left.is_zero, right_zero = right.is_zero;
  if (left_zero || right_zero) {
    // Only positive fields are 0 throughout. The result of a form or a difference depends on which operand is 0.
    const bool is_difference =
        op == Opcode::kSubtract || op == Opcode::kSubtractFrom || mode.form == operators::Form::kDifference;
    const bool left_is_first = op != Opcode::kSubtractFrom && !mode.is_exchanged;
    if (is_difference) {
      if (left_is_first ? left_zero : right_zero) return vanish();
      return left_is_first ? keep_left() : keep_right(), clamp();
    }
    if (op == Opcode::kMin || mode.form == operators::Form::kIntersection) return vanish();
    return right_zero ? keep_left() : keep_right();
  }
  if (mode.form == operators::Form::kUnion) {
    const bool greater = left.range.lo > right.range.hi, less = left.range.hi < right.range.lo;
    if (op == Opcode::kMax && (greater || less)) return greater ? keep_left() : keep_right();
    if (op == Opcode::kMin && (greater || less)) return less ? keep_left() : keep_right();
  }
  const Operation& o = tape_.operation(i);
  const bool is_signed = o.law == operators::Law::kSigned;
  const int alone = is_signed ? lone_operand(o, mode, left.range, right.range) : -1;
  if (alone >= 0) {
    (alone == 0) != mode.is_exchanged ? keep_left() : keep_right();
    if (o.what->weight(alone) != 1) {
      convert(instruction(Operand::kZero, Opcode::kLinear, 0, o.record + 1 + alone), out);
    }
    return;
  }
  const Interval range = binary_interval(op, o, mode, left.range, right.range);
  if (!is_signed && range.hi <= 0) return vanish();
  out.push_back(i);
  left.range = range;
}

void Pruner::convert(const Instruction& i, std::vector<Instruction>& out) {
  Value& value = stack_.back();
  if (i.op() == Opcode::kSoften) {
    const double range = tape_.operation(i).range;
    if (value.range.lo >= range) {
      out.resize(value.begin);
      value = {{0, 0}, value.begin, true};
      return;
    }
    value.range = {std::max(soften(value.range.hi, range) - kValueRoom, 0.0),
                   soften(value.range.lo, range) + kValueRoom};
  } else {
    if (value.is_zero) out.push_back(instruction(Operand::kZero, Opcode::kPush));
    value.is_zero = false;
    const auto [factor, offset] = tape_.linear(i);
    const double a = value.range.lo * factor + offset, b = value.range.hi * factor + offset;
    const double room = kValueRoom * std::max({std::abs(a), std::abs(b), std::abs(offset)});
    value.range = {std::min(a, b) - room, std::max(a, b) + room};
  }
  out.push_back(i);
}

void Pruner::join_all(const Instruction& i, std::vector<Instruction>& out) {
  const Operation& o = tape_.operation(i);
  const Mode mode = i.mode();
  const std::size_t count = std::popcount(i.leaf);
  const std::size_t first = stack_.size() - count;
  std::vector<Interval> ranges;
  for (std::size_t n = first; n < stack_.size(); ++n) ranges.push_back(stack_[n].range);
  const std::size_t begin = stack_[first].begin;
  const std::uint32_t mask = active_operands(o, mode, i.leaf, ranges);
  if (mask != i.leaf) {
    // The loop runs backwards, so that the code that may still be erased keeps its place.
    std::size_t end = out.size();
    std::vector<Interval> left;
    std::size_t at = stack_.size();
    for (std::uint32_t bit = operators::kMaxOperands; bit-- > 0;) {
      if (!(i.leaf >> bit & 1)) continue;
      --at;
      if (mask >> bit & 1) {
        left.insert(left.begin(), stack_[at].range);
      } else {
        out.erase(out.begin() + stack_[at].begin, out.begin() + end);
        end = stack_[at].begin;
        continue;
      }
      end = stack_[at].begin;
    }
    ranges = std::move(left);
  }
  stack_.resize(first + 1);
  if (std::has_single_bit(mask)) {
    const auto operand = static_cast<std::uint32_t>(std::countr_zero(mask));
    const double weight = o.what->weight(operand);
    stack_.back() = {ranges[0], begin};
    if (weight != 1) {
      convert(instruction(Operand::kZero, Opcode::kLinear, 0, o.record + 1 + operand), out);
    }
    return;
  }
  Instruction kept = i;
  kept.leaf = mask;
  out.push_back(kept);
  stack_.back() = {joint_interval(o, mode, mask, std::move(ranges)), begin};
}

Pruned Pruner::prune(const std::vector<Instruction>& source, std::size_t begin, std::size_t count, const Box& box,
                     std::vector<Instruction>& out) {
  const CentredBox centred(box);
  stack_.clear();
  for (std::size_t n = 0; n < count; ++n) {
    const Instruction i = source[begin + n];
    if (i.op() == Opcode::kLinear || i.op() == Opcode::kSoften) {
      convert(i, out);
      continue;
    }
    if (is_joint(i.op())) {
      join_all(i, out);
      continue;
    }
    Value right{{0, 0}, out.size()};
    bool fused = true;
    if (i.operand() == Operand::kPop) {
      right = stack_.back();
      stack_.pop_back();
      fused = false;
    } else if (i.is_leaf()) {
      bound_leaf(tape_.leaves[i.index], box, centred, right);
    } else {
      // The operand is the constant 0: nothing is left to be taken away, or a conversion starts from 0.
      right.is_zero = i.op() != Opcode::kPush;
    }
    if (i.op() == Opcode::kPush) {
      if (!right.is_zero) out.push_back(i);
      stack_.push_back(right);
    } else {
      join(i, right, fused, out);
    }
  }
  if (stack_.empty()) return {{0, 0}, true};
  return {stack_.back().range, stack_.back().is_zero};
}

}  // namespace isofield::blobtree
