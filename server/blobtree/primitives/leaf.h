// Leaves of a tape: primitives placed in the world. To the rooms above a leaf is a field with a gradient at a point, an
// interval over a box, a support box, a feature size and whether it may crease; what shape it has they do not know.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>

#include "blobtree/primitives/primitive.h"

namespace isofield::blobtree {

// What tells that a leaf does not reach a box stands first, within one line of the processor's cache: most leaves that
// culling asks are far away.
struct alignas(64) Leaf {
  Operand operand = Operand::kZero;
  operators::Law law = operators::Law::kPositive;
  std::uint32_t record = 0;  // its place in the buffer of leaves, in vec4
  std::uint32_t node = 0;    // in Scene::nodes
  // Positive: holds every point where the field is not 0, with room for float32 rounding. Signed: the shape itself.
  Box support;
  double range = 0;         // of a positive field
  double per_distance = 1;  // signed: the field is the distance times this
  double growth = 1;        // signed: where the field is at most r, the box grown by r times this holds the point
  Shape shape;              // in lengths of the world where its domain is rigid
  Domain domain;

  // The signed distance at a point of the world, in the shape's own lengths.
  double distance(const dvec3& p) const;
  bool may_crease() const { return traits_of(shape).may_crease; }
  // Half the thickness of its thinnest part, in the world, where the distance is `offset` (in the shape's own lengths);
  // 0 or less where there is nothing left of it.
  double feature_size(double offset) const;
  // Roughly the area of its surface, in the world.
  double area() const;
};

// Places a primitive. INVALID_ARGUMENT: its place takes it out of the range of lengths that float32 holds; the message
// names the node by `path`.
absl::StatusOr<Leaf> place_leaf(const Primitive& primitive, const Affine& to_world, const std::string& path);

// Bounds of leaf.distance() over a box, with room for what float32 makes of it on the device.
Interval distance_bounds(const Leaf& leaf, const CentredBox& box);

// Bounds of its field over a box, for the device's float32 results, too.
Interval field_bounds(const Leaf& leaf, const CentredBox& box);

// Whether a positive leaf's field is 0 throughout the box.
bool vanishes(const Leaf& leaf, const Box& box);

// Writes the leaf's record of record_size(leaf.operand) vec4s.
void write_leaf(const Leaf& leaf, Float4* out);

inline constexpr double kMaxCondition = 1e6;  // of a transform's linear part

}  // namespace isofield::blobtree
