// What every kind of primitive says of itself. primitive.h has the table of all kinds; server/README.md tells how to add
// one.
//
// A kind is a struct of its lengths in a frame of its own, with these members:
//   kTraits                       what holds of every primitive of the kind
//   read(message, in, frame)      reads them from the kind's message; `frame` leads from its own frame to the node's, and
//                                 refusals go to `in`
//   distance(q)                   the signed distance of a point, a template over the vector: the canonical definition,
//                                 which culling evaluates in double precision, reference/ differentiates automatically,
//                                 and the kind's .glsl mirrors with derivatives by hand
//   scaled(factor)                the same shape in lengths so many times as long
//   largest()                     its largest length
//   own_lengths()                 the sum of those lengths that a distance is computed from, of which float32 rounds a part
//   least_radius()                its feature size: half the thickness of its thinnest part
//   area()                        roughly, that of its surface; 0 where it has no end
//   growth()                      the most that a point's way to the surface is longer than its distance says
//   support(place, range)         a box of the world that holds every point of a distance of at most `range`, for a shape
//                                 that lies as `place` says
//   operand(is_rigid)             what an instruction of a tape holds of it; of one that keeps lengths, where is_rigid
//   write(place, operand, out)    the record of that operand, which the kind's .glsl reads
// and where a distance's bounds over a box are tighter than its slope tells
//   box_bounds(place, box)
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "base/field_reader.h"
#include "base/float4.h"
#include "base/interval.h"
#include "blobtree/geometry/affine.h"
#include "blobtree/geometry/box.h"

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

// Where a leaf lies: the point p of the world is q = to_local (p - anchor) in the shape's own frame.
struct Place {
  Affine to_local;  // linear part only
  dvec3 anchor;
  bool is_rigid = false;  // to_local keeps lengths
  // What the kernels make a field of a distance with: how fast the argument of the falloff grows with it, or of a signed
  // field minus what it is multiplied by.
  float slope = 0;
};

// The first four vec4s of the record of a shape under any affine map: the anchor with the slope, and the rows of the map
// with three numbers of the shape's own beside them.
inline void write_rows(const Place& place, double p0, double p1, double p2, Float4* out) {
  const auto& m = place.to_local.linear;
  out[0] = {f32(place.anchor.x), f32(place.anchor.y), f32(place.anchor.z), place.slope};
  out[1] = {f32(m[0].x), f32(m[0].y), f32(m[0].z), f32(p0)};
  out[2] = {f32(m[1].x), f32(m[1].y), f32(m[1].z), f32(p1)};
  out[3] = {f32(m[2].x), f32(m[2].y), f32(m[2].z), f32(p2)};
}

// The box of the image of a box, and of an ellipsoid, around the shape's own origin.
Box box_image(const Affine& to_world, const dvec3& half);
Box ellipsoid_image(const Affine& to_world, const dvec3& semi_axes);

}  // namespace isofield::blobtree
