#include "blobtree/primitives/leaf_placer.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

namespace isofield::blobtree {
namespace {

// Computed stretches are within this part of the exact ones; those of a turn, for example, are not quite 1.
constexpr double kStretchRounding = 1e-9;

// Half the extents of the support of a shape centred in its own frame: of all but the segment.
dvec3 local_half(Shape shape, const ShapeSize& s, double h) {
  switch (shape) {
    case Shape::kSphere:
      return {s[0] + h, s[0] + h, s[0] + h};
    case Shape::kSegment:
      break;
    case Shape::kBox:
      return {s[0] + h, s[1] + h, s[2] + h};
    case Shape::kCylinder:
      return {s[1] + h, s[1] + h, s[0] + h};
    case Shape::kTorus:
      return {s[0] + s[1] + h, s[0] + s[1] + h, s[1] + h};
    case Shape::kEllipsoid: {
      const double grow = 1 + h / std::min({s[0], s[1], s[2]});
      return {s[0] * grow, s[1] * grow, s[2] * grow};
    }
  }
  return {};
}

bool is_round(Shape shape) {
  return shape == Shape::kSphere || shape == Shape::kEllipsoid;
}

// Half extents of the image of the local support. Round supports fill less of their box than its corners span.
dvec3 world_half(const Affine& to_world, const dvec3& half, bool round) {
  const auto extent = [&](const dvec3& row) {
    const dvec3 v{row.x * half.x, row.y * half.y, row.z * half.z};
    return round ? length(v) : std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  };
  return {extent(to_world.linear[0]), extent(to_world.linear[1]), extent(to_world.linear[2])};
}

Box segment_support(const Leaf& leaf, const Affine& to_world) {
  // The hull of two spheres: far tighter than the box of a tilted local box.
  const dvec3 b = to_world.point({0, 0, leaf.size[0]});
  const auto ball = [&](const dvec3& c, double r) {
    const dvec3 half = world_half(to_world, {r, r, r}, true);
    return Box{c - half, c + half};
  };
  Box box = ball(leaf.anchor, leaf.size[1] + leaf.range);
  box.add(ball(b, leaf.size[2] + leaf.range));
  return box;
}

// Room for the rounding of coordinates and lengths to float32 on the device.
void pad(Box& box) {
  const auto grow = [](double& low, double& high) {
    const double room = 1e-6 * std::max(std::abs(low), std::abs(high));
    low -= room;
    high += room;
  };
  grow(box.min.x, box.max.x);
  grow(box.min.y, box.max.y);
  grow(box.min.z, box.max.z);
}

}  // namespace

std::uint32_t leaf_record_size(Operand operand) {
  switch (operand) {
    case Operand::kSphere:
      return 2;
    case Operand::kSegment:
      return 3;
    case Operand::kBox:
      return 5;
    default:
      return 4;
  }
}

absl::StatusOr<Leaf> place_leaf(const Node& node, const Affine& to_world) {
  Affine place = to_world.after(node.frame);
  Leaf leaf;
  leaf.shape = node.shape;
  leaf.size = node.size;
  leaf.range = node.range;
  leaf.law = node.law;
  const Affine::Stretch stretch = place.stretch();
  const bool similar = stretch.most - stretch.least <= kStretchRounding * stretch.most;
  if (similar) {
    // Distances scale with the map: scale the lengths instead and keep the placement rigid.
    const double factor = stretch.most;
    for (double& length : leaf.size) length *= factor;
    leaf.range *= factor;
    leaf.per_distance = 1 / factor;
    for (dvec3& row : place.linear) row = row * (1 / factor);
  }
  const std::optional<Affine> inverse = place.inverse();
  const auto near_enough = [](double x) { return std::abs(x) <= kMaxCoordinate; };
  const double largest = std::max(*std::max_element(node.size.begin(), node.size.end()), node.range);
  // A signed field is the distance over the scale: of it a length of 1 tells how large it may be.
  const bool is_signed = node.law == operators::Law::kSigned;
  const double least_length = is_signed ? 1 : node.range;
  // Maps that each are well conditioned may multiply to one that is not, and whose least stretch is lost in rounding.
  if (!inverse || !(stretch.least * (kMaxCondition * 1.001) >= stretch.most) ||
      !(least_length * stretch.least >= kMinLength * (1 - kStretchRounding)) ||
      !near_enough(largest * stretch.most) || !near_enough(place.offset.x) || !near_enough(place.offset.y) ||
      !near_enough(place.offset.z)) {
    std::string text =
        absl::StrCat(node.path, ": the transforms above scale it by ", stretch.least, " to ", stretch.most,
                     " and place it at (", place.offset.x, ", ", place.offset.y, ", ", place.offset.z,
                     "): expected lengths within [", kMinLength, ", ", kMaxCoordinate, "], coordinates of at most ",
                     kMaxCoordinate, " and a condition number of at most ", kMaxCondition);
    if (is_signed) {
      absl::StrAppend(&text, "; of a SIGNED field, which is the distance over the scale, a scale of at least ",
                      kMinLength);
    }
    return absl::InvalidArgumentError(text);
  }
  leaf.anchor = place.offset;
  leaf.to_local = {inverse->linear, {}};
  leaf.stretch = similar ? 1 : 1 / stretch.least;
  leaf.growth = stretch.most;
  if (leaf.shape == Shape::kEllipsoid) {
    const auto [least, most] = std::minmax({node.size[0], node.size[1], node.size[2]});
    leaf.growth *= most / least;
  }

  switch (leaf.shape) {
    case Shape::kSphere:
      leaf.operand = similar ? Operand::kSphere : Operand::kEllipsoid;
      break;
    case Shape::kSegment:
      leaf.operand = similar ? Operand::kSegment : Operand::kAffineSegment;
      break;
    case Shape::kBox:
      leaf.operand = Operand::kBox;
      break;
    case Shape::kCylinder:
      leaf.operand = Operand::kCylinder;
      break;
    case Shape::kTorus:
      leaf.operand = Operand::kTorus;
      break;
    case Shape::kEllipsoid:
      leaf.operand = Operand::kEllipsoid;
      break;
  }
  if (leaf.shape == Shape::kSegment) {
    leaf.support = segment_support(leaf, place);
  } else {
    const dvec3 half = world_half(place, local_half(leaf.shape, leaf.size, leaf.range), is_round(leaf.shape));
    leaf.support = {place.offset - half, place.offset + half};
  }
  pad(leaf.support);
  return leaf;
}

}  // namespace isofield::blobtree
