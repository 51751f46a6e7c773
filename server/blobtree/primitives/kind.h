// What every kind of primitive says of itself. primitive.h has the table of all kinds; server/README.md tells how to
// add one.
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
  std::string_view name;  // of the kind's field in the message Node, and of its .glsl
  bool may_crease;        // whether its surface has edges
};

// The right operand of an instruction (primitive.h).
enum class Operand : std::uint8_t;

// The number by which a kernel turns a distance into a field. Of positive fields it is how fast the argument of the
// falloff grows with the distance, (1 - r0) / range; of signed fields minus the factor of the distance. The sign tells
// the laws apart.
using Slope = float;

// The first four vec4s of the record of a shape in any affine domain: the anchor with the slope, and the rows of the
// map with three numbers of the shape's own beside them.
inline void write_rows(const Domain& domain, Slope slope, double p0, double p1, double p2, Float4* out) {
  const auto& m = domain.to_local.linear;
  out[0] = {f32(domain.anchor.x), f32(domain.anchor.y), f32(domain.anchor.z), slope};
  out[1] = {f32(m[0].x), f32(m[0].y), f32(m[0].z), f32(p0)};
  out[2] = {f32(m[1].x), f32(m[1].y), f32(m[1].z), f32(p1)};
  out[3] = {f32(m[2].x), f32(m[2].y), f32(m[2].z), f32(p2)};
}

// A kind is a struct of its lengths in a frame of its own. Beside what stands here it has
//   static K read(message, FieldReader& in, Affine& frame)
// which reads them from the kind's message; `frame` leads from its own frame to the node's, and refusals go to `in`.
template <class K>
concept PrimitiveKind = requires(const K& kind, const dvec3& q, const Affine& to_world, const Domain& domain,
                                 Slope slope, Operand operand, double number, bool is_rigid, Float4* out) {
  { K::kTraits } -> std::convertible_to<PrimitiveTraits>;
  // The signed distance of a point, a template over the vector. It is the canonical definition: culling evaluates it in
  // double precision, reference/ differentiates it automatically, and the kind's .glsl mirrors it with derivatives by
  // hand.
  { kind.distance(q) } -> std::same_as<double>;
  // The same shape in lengths `number` times as long.
  { kind.scaled(number) } -> std::same_as<K>;
  { kind.largest() } -> std::same_as<double>;  // of its lengths
  // The sum of those lengths that a distance is computed from: float32 rounds a part of it.
  { kind.own_lengths() } -> std::same_as<double>;
  // Its feature size: half the thickness of its thinnest part.
  { kind.least_radius() } -> std::same_as<double>;
  // Roughly the area of its surface; 0 where it has no end.
  { kind.area() } -> std::same_as<double>;
  // The largest ratio of the true way to the surface to what distance() says outside: 1 where it is exact.
  { kind.growth() } -> std::same_as<double>;
  // A box of the world that holds every point of a distance of at most `number`, where the map leads the shape's frame
  // to the world.
  { kind.support(to_world, number) } -> std::same_as<Box>;
  // What an instruction of a tape holds of it, in a domain that keeps lengths or in any.
  { kind.operand(is_rigid) } -> std::same_as<Operand>;
  // Writes the record of that operand, which the kind's .glsl reads.
  { kind.write(domain, slope, operand, out) } -> std::same_as<void>;
};

// A kind whose distance over a box has bounds that are tighter than its slope tells; nothing where the domain is not
// one for them.
template <class K>
concept HasBoxBounds = requires(const K& kind, const Domain& domain, const CentredBox& box) {
  { kind.box_bounds(domain, box) } -> std::same_as<std::optional<Interval>>;
};

// The box of the image of a box, and of an ellipsoid, around the shape's own origin.
Box box_image(const Affine& to_world, const dvec3& half);
Box ellipsoid_image(const Affine& to_world, const dvec3& semi_axes);

// A kind that is the same about several points, and chooses the one that its record is written about.
template <class K>
concept ChoosesItsAnchor = requires(const K& kind, const Domain& domain) {
  { kind.anchor(domain) } -> std::same_as<dvec3>;
};

}  // namespace isofield::blobtree
