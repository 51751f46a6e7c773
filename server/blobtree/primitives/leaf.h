// A Leaf is a primitive placed in the world, as a tape holds it. The rooms above see a leaf as a distance at a point,
// an interval over a box, a support box, a feature size and whether it may crease; they do not know its shape.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>

#include "blobtree/primitives/primitive.h"

namespace isofield::blobtree {

// The members that tell that a leaf does not reach a box stand first and share one line of the processor's cache,
// because most leaves that culling asks about are far away.
struct alignas(64) Leaf {
  Operand operand = Operand::kZero;
  operators::Law law = operators::Law::kPositive;
  std::uint32_t record = 0;  // place of its record in the buffer of leaves, in vec4s
  std::uint32_t node = 0;    // index in Scene::nodes
  // For a positive field, the box holds every point where the field is not 0, with room for float32 rounding. For a
  // signed field, it holds the shape itself.
  Box support;
  double range = 0;         // only for positive fields
  double per_distance = 1;  // signed fields: the field is the distance times this
  double growth = 1;        // signed fields: the box grown by r times this holds every point where the field is <= r
  Shape shape;              // its lengths are those of the world if the domain is rigid
  Domain domain;

  // Returns the signed distance at a point of the world, in the shape's own lengths.
  double distance(const dvec3& p) const;
  bool may_crease() const { return traits_of(shape).may_crease; }
  // Returns half the thickness, in the world, of the thinnest part of the solid where the distance is at most `offset`
  // (in the shape's own lengths). The result is 0 or less if nothing is left of that part.
  double feature_size(double offset) const;
  // Returns roughly the area of the surface, in the world.
  double area() const;
};

// Places a primitive in the world. INVALID_ARGUMENT: the placed primitive has lengths or coordinates that float32 does
// not hold well, or its map is nearly singular; the message names the node by `path`.
absl::StatusOr<Leaf> place_leaf(const Primitive& primitive, const Affine& to_world, const std::string& path);

// Returns bounds of leaf.distance() over a box, with room for the rounding of float32 on the device.
Interval distance_bounds(const Leaf& leaf, const CentredBox& box);

// Returns bounds of the leaf's field over a box. They hold for the device's float32 results, too.
Interval field_bounds(const Leaf& leaf, const CentredBox& box);

// Returns whether the field of a positive leaf is 0 throughout the box.
bool vanishes(const Leaf& leaf, const Box& box);

// Writes the leaf's record, which takes record_size(leaf.operand) vec4s.
void write_leaf(const Leaf& leaf, Float4* out);

inline constexpr double kMaxCondition = 1e6;  // largest condition number of a transform's linear part

}  // namespace isofield::blobtree
