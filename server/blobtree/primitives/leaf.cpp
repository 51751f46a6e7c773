#include "blobtree/primitives/leaf.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

#include "blobtree/primitives/falloff.h"

namespace isofield::blobtree {
namespace {

// Computed stretches differ from the exact ones by at most this part; for example, that of a rotation is not exactly 1.
constexpr double kStretchRounding = 1e-9;
// A length that float32 computes differs from the exact one by at most this, relative to the coordinates that it is
// computed from.
constexpr double kLengthRoom = 1e-6;

// Grows the box by what float32 may round on the device. An infinite end does not count towards the room of the other
// end.
void pad(Box& box) {
  const auto size = [](double end) { return std::isfinite(end) ? std::abs(end) : 0; };
  for (int axis = 0; axis < 3; ++axis) {
    const double room = 1e-6 * std::max(size(box.min[axis]), size(box.max[axis]));
    box.min[axis] -= room;
    box.max[axis] += room;
  }
}

absl::Status refuse_place(const std::string& path, const Affine& place, const Affine::Stretch& stretch,
                          bool is_signed) {
  using base::kMaxCoordinate, base::kMinLength;
  std::string text =
      absl::StrCat(path, ": the transforms above scale it by ", stretch.least, " to ", stretch.most,
                   " and place it at (", place.offset.x, ", ", place.offset.y, ", ", place.offset.z,
                   "): expected lengths within [", kMinLength, ", ", kMaxCoordinate, "], coordinates of at most ",
                   kMaxCoordinate, " and a condition number of at most ", kMaxCondition);
  if (is_signed) {
    absl::StrAppend(&text, "; of a SIGNED field, which is the distance over the scale, a scale of at least ",
                    kMinLength);
  }
  return absl::InvalidArgumentError(text);
}

}  // namespace

double Leaf::distance(const dvec3& p) const {
  const dvec3 q = domain.point(p);
  return std::visit([&](const auto& s) { return s.distance(q); }, shape);
}

double Leaf::feature_size(double offset) const {
  return (std::visit([](const auto& s) { return s.least_radius(); }, shape) + offset) / domain.stretch;
}

double Leaf::area() const {
  const double scale = domain.is_rigid ? 1 : growth;
  return std::visit([](const auto& s) { return s.area(); }, shape) * scale * scale;
}

absl::StatusOr<Leaf> place_leaf(const Primitive& primitive, const Affine& to_world, const std::string& path) {
  Affine place = to_world.after(primitive.frame);
  Leaf leaf;
  leaf.shape = primitive.shape;
  leaf.range = primitive.range;
  leaf.law = primitive.law;
  const Affine::Stretch stretch = place.stretch();
  leaf.domain.is_rigid = stretch.most - stretch.least <= kStretchRounding * stretch.most;
  if (leaf.domain.is_rigid) {
    // Distances scale with the map, so the lengths are scaled instead and the placement stays rigid.
    const double factor = stretch.most;
    leaf.shape = std::visit([&](const auto& s) -> Shape { return s.scaled(factor); }, leaf.shape);
    leaf.range *= factor;
    leaf.per_distance = 1 / factor;
    for (dvec3& row : place.linear) row = row * (1 / factor);
  }
  const std::optional<Affine> inverse = place.inverse();
  const auto near_enough = [](double x) { return std::abs(x) <= base::kMaxCoordinate; };
  const double longest = std::visit([](const auto& s) { return s.largest(); }, primitive.shape);
  const double largest = std::max(longest, primitive.range);
  // A signed field has no range and is the distance divided by the scale, so the scale itself (a length of 1) is
  // checked instead.
  const bool is_signed = primitive.law == operators::Law::kSigned;
  const double least_length = is_signed ? 1 : primitive.range;
  // The product of well-conditioned maps may be badly conditioned, and its least stretch is then lost in rounding.
  if (!inverse || !(stretch.least * (kMaxCondition * 1.001) >= stretch.most) ||
      !(least_length * stretch.least >= base::kMinLength * (1 - kStretchRounding)) ||
      !near_enough(largest * stretch.most) || !near_enough(place.offset.x) || !near_enough(place.offset.y) ||
      !near_enough(place.offset.z)) {
    return refuse_place(path, place, stretch, is_signed);
  }
  leaf.domain.anchor = place.offset;
  leaf.domain.to_local = {inverse->linear, {}};
  leaf.domain.stretch = leaf.domain.is_rigid ? 1 : 1 / stretch.least;
  std::visit(
      [&]<class S>(const S& s) {
        if constexpr (ChoosesItsAnchor<S>) leaf.domain.anchor = s.anchor(leaf.domain);
      },
      leaf.shape);
  leaf.growth = stretch.most * std::visit([](const auto& s) { return s.growth(); }, primitive.shape);
  leaf.operand = std::visit([&](const auto& s) { return s.operand(leaf.domain.is_rigid); }, leaf.shape);
  leaf.support = std::visit([&](const auto& s) { return s.support(place, leaf.range); }, leaf.shape);
  pad(leaf.support);
  return leaf;
}

Interval distance_bounds(const Leaf& leaf, const CentredBox& box) {
  const dvec3 c = absolute(box.centre);
  const double size = std::max({c.x, c.y, c.z, box.radius}) * leaf.domain.stretch;
  return std::visit(
      [&]<class S>(const S& shape) {
        const double room = kLengthRoom * (size + leaf.range + shape.own_lengths());
        std::optional<Interval> exact;
        if constexpr (HasBoxBounds<S>) exact = shape.box_bounds(leaf.domain, box);
        if (!exact) {
          const double d = leaf.distance(box.centre), reach = box.radius * leaf.domain.stretch;
          exact = {d - reach, d + reach};
        }
        return Interval{exact->lo - room, exact->hi + room};
      },
      leaf.shape);
}

Interval field_bounds(const Leaf& leaf, const CentredBox& box) {
  const Interval d = distance_bounds(leaf, box);
  if (leaf.law == operators::Law::kSigned) return {d.lo * leaf.per_distance, d.hi * leaf.per_distance};
  if (d.lo >= leaf.range) return {0, 0};
  return {std::max(soften(d.hi, leaf.range) - base::kValueRoom, 0.0), soften(d.lo, leaf.range) + base::kValueRoom};
}

bool vanishes(const Leaf& leaf, const Box& box) {
  return !leaf.support.touches(box) || distance_bounds(leaf, CentredBox(box)).lo >= leaf.range;
}

void write_leaf(const Leaf& leaf, Float4* out) {
  const bool is_signed = leaf.law == operators::Law::kSigned;
  const Slope slope = f32(is_signed ? -leaf.per_distance : (1 - kR0) / leaf.range);
  std::visit([&](const auto& s) { s.write(leaf.domain, slope, leaf.operand, out); }, leaf.shape);
}

}  // namespace isofield::blobtree
