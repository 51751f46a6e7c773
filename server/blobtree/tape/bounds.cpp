#include "blobtree/tape/bounds.h"

#include <algorithm>

#include "operators/operator.h"

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Kind;
using operators::Law;
using operators::Spread;

void intersect(Box& a, const Box& b) {
  a.min = {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)};
  a.max = {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)};
  if (a.empty()) a = {};
}

void join_positive(Box& box, const operators::Operator& op, std::size_t operand, const Box& next) {
  const bool is_difference = op.form == Form::kDifference;
  const bool is_intersection = op.kind() == Kind::kMin || op.form == Form::kIntersection;
  if (operand == 0) {
    box = next;
  } else if (is_intersection) {
    intersect(box, next);
  } else if (!is_difference) {
    box.add(next);
  }
}

// Turns bounds of an operand into bounds of the result.
Bounds spread(const Bounds& b, const Spread& s) {
  const double limit = s.times > 0 ? (b.limit - s.reach) * s.over / s.times : s.limit;
  return {b.within(s.reach), b.growth * s.times / s.over, std::min(limit, s.limit)};
}

// Returns the bounds of a union, as far as this operand decides them.
Bounds reached(const operators::Operator& op, std::size_t operand, const Bounds& b) {
  return op.visit([&]<class K>(const K& kind) {
    if constexpr (operators::IsSigned<K>) {
      return spread(b, kind.reached(operand));
    } else {
      return b;
    }
  });
}

// Returns the bounds of an intersection or a difference from one operand, below which the result falls no further than
// kept() says.
Bounds kept(const operators::Operator& op, std::size_t operand, const Bounds& b) {
  return op.visit([&]<class K>(const K& kind) {
    if constexpr (operators::IsSigned<K>) {
      return spread(b, kind.kept(operand));
    } else {
      return b;
    }
  });
}

void join_signed(Bounds& so_far, const operators::Operator& op, std::size_t operand, const Bounds& next) {
  const bool is_difference = op.form == Form::kDifference;
  const bool is_intersection = op.kind() == Kind::kMax || op.form == Form::kIntersection;
  const bool is_joint = op.is_joint();
  // A folded operator takes what it has so far and the next operand.
  if (operand == 0) {
    so_far = next;
    if (!is_joint) return;
  }
  const std::size_t place = is_joint ? operand : 1;
  if (is_difference || is_intersection) {
    if (!is_joint || operand == 0) so_far = kept(op, 0, so_far);
    // Each operand bounds an intersection. The first one that is bounded is taken.
    if (is_intersection && operand > 0 && !so_far.box.is_bounded()) {
      const Bounds other = kept(op, place, next);
      if (other.box.is_bounded()) so_far = other;
    }
    return;
  }
  const Bounds b = reached(op, place, next);
  if (is_joint && operand == 0) {
    so_far = b;
    return;
  }
  if (!is_joint) so_far = reached(op, 0, so_far);
  so_far.box.add(b.box);
  so_far.growth = std::max(so_far.growth, b.growth);
  so_far.limit = std::min(so_far.limit, b.limit);
}

}  // namespace

Box Bounds::within(double r) const {
  if (r >= limit) return Box::everywhere();
  // A field without a solid may still be at most r somewhere, and nothing is known of the place.
  if (box.empty()) return r > 0 ? Box::everywhere() : box;
  const dvec3 room{r * growth, r * growth, r * growth};
  return {box.min - room, box.max + room};
}

void join_bounds(Bounds& so_far, const operators::Operator& op, Law law, std::size_t operand, const Bounds& next) {
  if (law == Law::kPositive) {
    join_positive(so_far.box, op, operand, next.box);
  } else {
    join_signed(so_far, op, operand, next);
  }
}

Bounds softened(const Bounds& b, double range) {
  return {b.within(range)};
}

Bounds hardened(const Bounds& b) {
  return {b.box, 0, 0.5};
}

}  // namespace isofield::blobtree
