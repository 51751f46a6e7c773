#include "blobtree/cull/intervals.h"

#include <algorithm>
#include <utility>

namespace isofield::blobtree {
namespace {

using operators::Form;

// Bounds a union, whose operands come in their order.
Interval union_interval(Opcode op, const Operation& o, const Interval& a, const Interval& b) {
  // Large scenes are mostly sums, and finding the kind of the operator would cost as much as the sum.
  if (op == Opcode::kSum) return operators::Sum().bound(a, b);
  if (op == Opcode::kSubtract) return operators::Difference::bound_positive(a, b);
  return o.what->visit([&]<class K>(const K& kind) -> Interval {
    if constexpr (operators::IsSteered<K>) {
      return kind.bound(a, b, o.growth);
    } else if constexpr (operators::IsFolded<K>) {
      return kind.bound(a, b);
    } else {
      return b;  // joint operators are bounded by joint_interval()
    }
  });
}

// Takes the complements of a joint operator's operands if its form asks for them.
void turn(const Mode& mode, std::uint32_t mask, std::vector<Interval>& x) {
  if (mode.form == Form::kUnion) return;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool is_first = i == 0 && (mask & 1) != 0;
    if (mode.form == Form::kIntersection || is_first) x[i] = complement(x[i], true);
  }
}

}  // namespace

Interval complement(const Interval& i, bool is_signed) {
  const double whole = is_signed ? 0 : 1;
  return {whole - i.hi, whole - i.lo};
}

Interval binary_interval(Opcode op, const Operation& o, const Mode& mode, Interval a, Interval b) {
  if (op == Opcode::kSubtractFrom) return union_interval(Opcode::kSubtract, o, b, a);
  if (mode.is_exchanged) std::swap(a, b);
  if (mode.form == Form::kUnion) return union_interval(op, o, a, b);
  const auto inside_out = [&](const Interval& i) {
    Interval c = complement(i, mode.is_signed);
    if (!mode.is_signed) c = {std::max(c.lo, 0.0), std::max(c.hi, 0.0)};
    return c;
  };
  const Interval first = a, second = b;
  a = inside_out(a);
  if (mode.form == Form::kIntersection) b = inside_out(b);
  Interval r = inside_out(union_interval(op, o, a, b));
  if (mode.form == Form::kIntersection && !mode.is_signed) {
    // The intersection of fields above 1 is the least of them.
    if (std::min(first.lo, second.lo) >= 1) r.lo = std::min(first.lo, second.lo);
    if (std::min(first.hi, second.hi) >= 1) r.hi = std::min(first.hi, second.hi);
  }
  // The complements are rounded, too.
  return {mode.is_signed ? r.lo : std::max(r.lo - kValueRoom, 0.0), r.hi <= 0 ? r.hi : r.hi + kValueRoom};
}

Interval joint_interval(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> x) {
  turn(mode, mask, x);
  const Interval r = o.what->visit([&]<class K>(const K& kind) -> Interval {
    if constexpr (operators::IsJoint<K>) {
      return kind.bound_all({mask, o.operands}, x);
    } else {
      return x.back();  // folded operators are bounded by binary_interval()
    }
  });
  return mode.form == Form::kUnion ? r : complement(r, true);
}

std::uint32_t active_operands(const Operation& o, const Mode& mode, std::uint32_t mask, std::vector<Interval> x) {
  turn(mode, mask, x);
  const std::uint32_t active = o.what->visit([&]<class K>(const K& kind) {
    if constexpr (operators::IsJoint<K>) {
      return kind.active({mask, o.operands}, x);
    } else {
      return mask;
    }
  });
  // The subtrahends alone are never what is left of a difference.
  return mode.form == Form::kDifference ? active | (mask & 1) : active;
}

int lone_operand(const Operation& o, const Mode& mode, Interval a, Interval b) {
  if (mode.is_exchanged) std::swap(a, b);
  if (mode.form != Form::kUnion) a = complement(a, true);
  if (mode.form == Form::kIntersection) b = complement(b, true);
  const int lone = o.what->visit([&]<class K>(const K& kind) {
    if constexpr (operators::KnowsALoneOperand<K>) {
      return kind.lone_operand(a, b);
    } else {
      return -1;
    }
  });
  // A lone subtrahend is not the result itself, but its complement.
  return lone == 1 && mode.form == Form::kDifference ? -1 : lone;
}

}  // namespace isofield::blobtree
