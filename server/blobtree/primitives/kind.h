// The concept PrimitiveKind lists what every kind of primitive provides. primitive.h has the table of all kinds;
// server/README.md tells how to add one.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/field_reader.h"
#include "base/float4.h"
#include "base/interval.h"
#include "blobtree/geometry/box.h"
#include "blobtree/primitives/domain.h"

namespace isofield::blobtree {

using base::f32;
using base::FieldReader;
using base::Float4;
using base::Interval;

struct PrimitiveTraits {
  std::string_view name;  // names the kind's field in the message Node, and its .glsl
  bool may_crease;        // its surface has edges
};

// Operand names the right operand of an instruction (primitive.h).
enum class Operand : std::uint8_t;

// Slope is the number by which a kernel turns a distance into a field. For positive fields it is (1 - r0) / range,
// which is how fast the argument of the falloff grows with the distance. For signed fields it is minus the factor of
// the distance. The sign tells the laws apart.
using Slope = float;

// Writes the first four vec4s of the record of a shape in any affine domain: the anchor with the slope, and the rows of
// the map with three numbers of the shape's own (p0, p1, p2) beside them.
inline void write_rows(const Domain& domain, Slope slope, double p0, double p1, double p2, Float4* out) {
  const auto& m = domain.to_local.linear;
  out[0] = {f32(domain.anchor.x), f32(domain.anchor.y), f32(domain.anchor.z), slope};
  out[1] = {f32(m[0].x), f32(m[0].y), f32(m[0].z), f32(p0)};
  out[2] = {f32(m[1].x), f32(m[1].y), f32(m[1].z), f32(p1)};
  out[3] = {f32(m[2].x), f32(m[2].y), f32(m[2].z), f32(p2)};
}

// A kind is a struct of the lengths of a shape in the shape's own frame. Besides the functions below it has
//   static K read(message, FieldReader& in, Affine& frame)
// This function reads the lengths from the kind's message. It sets `frame` to the map from the shape's own frame to the
// node's, and reports refusals to `in`.
template <class K>
concept PrimitiveKind = requires(const K& kind, const dvec3& q, const Affine& to_world, const Domain& domain,
                                 Slope slope, Operand operand, double number, bool is_rigid, Float4* out) {
  { K::kTraits } -> std::convertible_to<PrimitiveTraits>;
  // Returns the signed distance of a point; it is a template over the vector type. It defines the shape: culling
  // evaluates it in double precision, reference/ differentiates it automatically, and the kind's .glsl repeats it with
  // derivatives written by hand.
  { kind.distance(q) } -> std::same_as<double>;
  // Returns the same shape with all its lengths multiplied by `number`.
  { kind.scaled(number) } -> std::same_as<K>;
  { kind.largest() } -> std::same_as<double>;  // the largest of its lengths
  // Returns the sum of the lengths that a distance is computed from. The rounding error of float32 is proportional to
  // it.
  { kind.own_lengths() } -> std::same_as<double>;
  // Returns the feature size, which is half the thickness of the shape's thinnest part.
  { kind.least_radius() } -> std::same_as<double>;
  // Returns roughly the area of the surface, or 0 if the shape is unbounded.
  { kind.area() } -> std::same_as<double>;
  // Returns the largest ratio, outside of the shape, of the true distance to what distance() says. It is 1 where
  // distance() is exact.
  { kind.growth() } -> std::same_as<double>;
  // Returns a box of the world that holds every point with a distance of at most `number`. `to_world` maps the shape's
  // frame to the world.
  { kind.support(to_world, number) } -> std::same_as<Box>;
  // Returns the operand that an instruction has for the kind, either in a domain that keeps lengths or in any domain.
  { kind.operand(is_rigid) } -> std::same_as<Operand>;
  // Writes the record of that operand, which holds the numbers that the kind's .glsl reads.
  { kind.write(domain, slope, operand, out) } -> std::same_as<void>;
};

// HasBoxBounds holds for kinds that know tighter bounds of their distance over a box than its slope gives. box_bounds()
// returns nothing if it has none in this domain.
template <class K>
concept HasBoxBounds = requires(const K& kind, const Domain& domain, const CentredBox& box) {
  { kind.box_bounds(domain, box) } -> std::same_as<std::optional<Interval>>;
};

// These functions return the box around the image of a box, and of an ellipsoid, that lies around the shape's own
// origin.
Box box_image(const Affine& to_world, const dvec3& half);
Box ellipsoid_image(const Affine& to_world, const dvec3& semi_axes);

// ChoosesItsAnchor holds for kinds that are the same about several points. Such a kind chooses the point about which
// its record is written.
template <class K>
concept ChoosesItsAnchor = requires(const K& kind, const Domain& domain) {
  { kind.anchor(domain) } -> std::same_as<dvec3>;
};

}  // namespace isofield::blobtree
