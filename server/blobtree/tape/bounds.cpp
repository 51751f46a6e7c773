#include "blobtree/tape/bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blobtree/scene/scene.h"
#include "operators/ranged_blends.h"

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Kind;
using operators::Law;

// x1 + x2 - sqrt(x1^2 + x2^2) is at least this times the lesser of two positive fields.
constexpr double kRFunctionSlope = 2 - std::numbers::sqrt2;

void intersect(Box& a, const Box& b) {
  a.min = {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)};
  a.max = {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)};
  if (a.empty()) a = {};
}

// A box that holds everything that a scene may hold.
Box everywhere() {
  return {{-kMaxCoordinate, -kMaxCoordinate, -kMaxCoordinate}, {kMaxCoordinate, kMaxCoordinate, kMaxCoordinate}};
}

void join_positive(Box& box, const operators::Operator& op, std::size_t operand, const Box& next) {
  const bool is_difference = op.applied_form() == Form::kDifference;
  const bool is_intersection = op.kind == Kind::kMin || op.form == Form::kIntersection;
  if (operand == 0) {
    box = next;
  } else if (is_intersection) {
    intersect(box, next);
  } else if (!is_difference) {
    box.add(next);
  }
}

// Weights that follow the gradients grow to so many times the other.
double most_weight(const operators::Operator& op, std::size_t operand) {
  const double own = op.term(operand).weight;
  return op.by_angle ? std::max(own, op.term(1 - operand).weight * operators::kMostRatio) : own;
}

// Of a union of signed fields: the operand below which the result may reach r, as bounds of the operand's own.
Bounds reached(const operators::Operator& op, std::size_t operand, const Bounds& b) {
  switch (op.kind) {
    case Kind::kRUnion:
    case Kind::kPasko: {
      const double reach = op.kind == Kind::kPasko ? std::max(-op.a0, 0.0) / kRFunctionSlope : 0;
      return {b.within(reach), b.growth / kRFunctionSlope, (b.limit - reach) * kRFunctionSlope};
    }
    case Kind::kFunctional: {
      const double reach = std::max(op.curve.most(), 0.0);
      return {b.within(reach), b.growth, b.limit - reach};
    }
    case Kind::kSuperelliptic: {
      const double reach = op.term(operand).range * op.most_reach();
      return {b.within(reach), 0, 1};
    }
    case Kind::kBt2:
    case Kind::kBtk: {
      const operators::Term& t = op.term(operand);
      const double reach = t.range * op.most_reach(), weight = most_weight(op, operand);
      return {b.within(reach), b.growth * weight, (b.limit - reach) / weight};
    }
    default:
      return b;
  }
}

// Of an intersection or the first of a difference: the result is at least this operand over its weight.
Bounds kept(const operators::Operator& op, std::size_t operand, const Bounds& b) {
  switch (op.kind) {
    case Kind::kPasko:
      return {b.within(std::abs(op.a0)), b.growth, b.limit - std::abs(op.a0)};
    case Kind::kFunctional: {
      const double reach = std::max(-op.curve.least(), 0.0);
      return {b.within(reach), b.growth, b.limit - reach};
    }
    case Kind::kSuperelliptic: {
      const double range = op.term(operand).range * op.most_reach();
      return {b.box, b.growth * range, b.limit / range};
    }
    case Kind::kBt2:
    case Kind::kBtk: {
      const double weight = most_weight(op, operand);
      return {b.box, b.growth * weight, b.limit / weight};
    }
    default:
      return b;
  }
}

void join_signed(Bounds& so_far, const operators::Operator& op, std::size_t operand, const Bounds& next) {
  const bool is_difference = op.applied_form() == Form::kDifference;
  const bool is_intersection = op.kind == Kind::kMax || op.form == Form::kIntersection;
  const bool is_n_ary = op.is_n_ary();
  // A fold applies the operator to what it has so far and to the next.
  if (operand == 0) {
    so_far = next;
    if (!is_n_ary) return;
  }
  const std::size_t place = is_n_ary ? operand : 1;
  if (is_difference || is_intersection) {
    // Any operand of an intersection will do.
    if (!is_n_ary || operand == 0) so_far = kept(op, 0, so_far);
    return;
  }
  const Bounds b = reached(op, place, next);
  if (is_n_ary && operand == 0) {
    so_far = b;
    return;
  }
  if (!is_n_ary) so_far = reached(op, 0, so_far);
  so_far.box.add(b.box);
  so_far.growth = std::max(so_far.growth, b.growth);
  so_far.limit = std::min(so_far.limit, b.limit);
}

}  // namespace

Box Bounds::within(double r) const {
  if (r >= limit) return everywhere();
  // An empty solid may still be approached: nothing is known of where.
  if (box.empty()) return r > 0 ? everywhere() : box;
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
