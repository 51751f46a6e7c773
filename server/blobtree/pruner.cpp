#include "blobtree/pruner.h"

#include <algorithm>
#include <cmath>

namespace isofield::blobtree {
namespace {

// What float32 evaluation may differ from exact arithmetic: of a field value, and of a length relative to the
// coordinates it was computed from.
constexpr double kValueRoom = 4e-6;
constexpr double kLengthRoom = 1e-6;

bool is_zero(const Interval& i) {
  return i.hi <= 0;
}

Instruction with_operator(Instruction i, Operator op) {
  i.code = (i.code & 0xff) | static_cast<std::uint32_t>(op) << 8;
  return i;
}
Instruction with_operand(Instruction i, Operand operand) {
  i.code = (i.code & ~0xffu) | static_cast<std::uint32_t>(operand);
  return i;
}

double ricci(double a, double b, double t) {
  const double big = std::max(a, b), small = std::min(a, b);
  return big > 0 ? big * std::pow(1 + std::pow(small / big, t), 1 / t) : 0;
}

// Bounds of an operator whose operands are not 0 throughout.
Interval combine(Operator op, const Operation& o, const Interval& a, const Interval& b) {
  switch (op) {
    case Operator::kSum:
      return {a.lo + b.lo, a.hi + b.hi};
    case Operator::kMax:
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
    case Operator::kMin:
      return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
    case Operator::kSubtract:
      return {std::max(std::min(a.lo, 1 - b.hi) - kValueRoom, 0.0), std::min(a.hi, 1 - b.lo)};
    case Operator::kSubtractFrom:
      return {std::max(std::min(b.lo, 1 - a.hi) - kValueRoom, 0.0), std::min(b.hi, 1 - a.lo)};
    case Operator::kRicci:
      return {ricci(a.lo, b.lo, o.exponent), ricci(a.hi, b.hi, o.exponent) + kValueRoom};
    case Operator::kGradient:
    case Operator::kGradientTable:
      // Between the maximum and the blend at theta = 0, whatever the angle.
      return {std::max(a.lo, b.lo), std::max(a.hi, b.hi) + o.silhouette_bound * std::min(a.hi, b.hi) + kValueRoom};
    default:
      return b;
  }
}

}  // namespace

Interval Pruner::leaf_range(const Leaf& leaf, const Box& box, const dvec3& centre, double radius) const {
  if (!leaf.support.touches(box)) return {0, 0};
  const double d = leaf.distance(centre);
  const double size = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z), radius}) * leaf.stretch;
  const double reach = radius * leaf.stretch + kLengthRoom * (size + leaf.range + leaf.size[0] + leaf.size[1]);
  if (d - reach >= leaf.range) return {0, 0};
  return {std::max(soften(d + reach, leaf.range) - kValueRoom, 0.0), soften(d - reach, leaf.range) + kValueRoom};
}

void Pruner::join(const Instruction& i, const Value& right, bool fused, std::vector<Instruction>& out) {
  const Operator op = i.op();
  Value& left = stack_.back();
  const auto keep_right = [&] {
    out.erase(out.begin() + left.begin, out.begin() + right.begin);
    if (fused) out.push_back(with_operator(i, Operator::kPush));
    left.range = right.range;
  };
  const auto keep_left = [&] { out.resize(right.begin); };
  const auto vanish = [&] {
    out.resize(left.begin);
    left.range = {0, 0};
  };
  // f - 0 = min(f, 1): only sums and blends pass 1.
  const auto clamp = [&] {
    if (left.range.hi <= 1 + 2 * kValueRoom) return;
    out.push_back(with_operator(with_operand(i, Operand::kZero), Operator::kSubtract));
    left.range = {std::min(left.range.lo, 1.0), 1 + kValueRoom};
  };
  const bool left_zero = is_zero(left.range), right_zero = is_zero(right.range);
  switch (op) {
    case Operator::kMin:
      if (left_zero || right_zero) return vanish();
      break;
    case Operator::kSubtract:
      if (left_zero) return vanish();
      if (right_zero) return keep_left(), clamp();
      break;
    case Operator::kSubtractFrom:
      if (right_zero) return vanish();
      if (left_zero) return keep_right(), clamp();
      break;
    case Operator::kMax:
      if (right_zero || left.range.lo > right.range.hi) return keep_left();
      if (left_zero || right.range.lo > left.range.hi) return keep_right();
      break;
    default:
      if (right_zero) return keep_left();
      if (left_zero) return keep_right();
  }
  const Interval range = combine(op, tape_.operations[i.operation], left.range, right.range);
  if (is_zero(range)) return vanish();
  out.push_back(i);
  left.range = range;
}

Interval Pruner::prune(const std::vector<Instruction>& source, std::size_t begin, std::size_t count, const Box& box,
                       std::vector<Instruction>& out) {
  const dvec3 centre = (box.min + box.max) * 0.5;
  const double radius = length(box.max - box.min) * 0.5;
  stack_.clear();
  for (std::size_t n = 0; n < count; ++n) {
    const Instruction i = source[begin + n];
    Value right{{0, 0}, out.size()};
    bool fused = true;
    if (i.operand() == Operand::kPop) {
      right = stack_.back();
      stack_.pop_back();
      fused = false;
    } else if (i.is_leaf()) {
      right.range = leaf_range(tape_.leaves[i.index], box, centre, radius);
    }
    if (i.op() == Operator::kPush) {
      if (!is_zero(right.range)) out.push_back(i);
      stack_.push_back(right);
    } else {
      join(i, right, fused, out);
    }
  }
  return stack_.empty() ? Interval{} : stack_.back().range;
}

}  // namespace isofield::blobtree
