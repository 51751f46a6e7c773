// Signed distances of the shapes in their own frames: the canonical definitions, which the culling evaluates in double,
// reference/ differentiates automatically, and shaders/lib/leaves.glsl mirrors by name with derivatives by hand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "blobtree/geometry/vec3.h"

namespace isofield::blobtree {

enum class Shape { kSphere, kSegment, kBox, kCylinder, kTorus, kEllipsoid };

// Lengths of a shape in its own frame, in this order:
//   sphere     radius; centred at the origin
//   segment    length, radius at the origin, radius at (0, 0, length)
//   box        half size x, y, z, rounding; centred
//   cylinder   half length along z, radius; centred
//   torus      major radius around z, minor radius; centred
//   ellipsoid  semi-axes x, y, z; centred
using ShapeSize = std::array<double, 4>;

template <class T>
T sphere_distance(const Vec3<T>& q, const ShapeSize& s) {
  return length(q) - s[0];
}

// The round cone touches, for each point, one sphere of the family that spans it: that with centre (0, 0, c).
template <class T>
T segment_distance(const Vec3<T>& q, const ShapeSize& s) {
  using std::max, std::min, std::sqrt;
  const double drop = s[1] - s[2];
  if (std::abs(drop) >= s[0]) {  // one end's sphere contains the other
    const double centre = drop >= 0 ? 0 : s[0];
    return length(Vec3<T>{q.x, q.y, q.z - T(centre)}) - std::max(s[1], s[2]);
  }
  const double sin_tilt = drop / s[0], tan_tilt = sin_tilt / std::sqrt(1 - sin_tilt * sin_tilt);
  const T rho = sqrt(q.x * q.x + q.y * q.y);
  const T c = min(max(q.z - rho * tan_tilt, T(0.0)), T(s[0]));
  return length(Vec3<T>{q.x, q.y, q.z - c}) - (s[1] - c * sin_tilt);
}

template <class T>
T box_distance(const Vec3<T>& q, const ShapeSize& s) {
  using std::abs, std::max, std::min, std::sqrt;
  const T x = abs(q.x) - (s[0] - s[3]), y = abs(q.y) - (s[1] - s[3]), z = abs(q.z) - (s[2] - s[3]);
  const T inside = min(max(x, max(y, z)), T(0.0));
  const T px = max(x, T(0.0)), py = max(y, T(0.0)), pz = max(z, T(0.0));
  return sqrt(px * px + py * py + pz * pz) + inside - s[3];
}

template <class T>
T cylinder_distance(const Vec3<T>& q, const ShapeSize& s) {
  using std::abs, std::max, std::min, std::sqrt;
  const T side = sqrt(q.x * q.x + q.y * q.y) - s[1], end = abs(q.z) - s[0];
  const T outside_side = max(side, T(0.0)), outside_end = max(end, T(0.0));
  return min(max(side, end), T(0.0)) + sqrt(outside_side * outside_side + outside_end * outside_end);
}

template <class T>
T torus_distance(const Vec3<T>& q, const ShapeSize& s) {
  using std::sqrt;
  const T ring = sqrt(q.x * q.x + q.y * q.y) - s[0];
  return sqrt(ring * ring + q.z * q.z) - s[1];
}

// A lower bound of the distance outside, exact on the surface (scene.proto, Ellipsoid).
template <class T>
T ellipsoid_distance(const Vec3<T>& q, const ShapeSize& s) {
  const double least = std::min({s[0], s[1], s[2]});
  return length(Vec3<T>{q.x * (least / s[0]), q.y * (least / s[1]), q.z * (least / s[2])}) - least;
}

template <class T>
T shape_distance(Shape shape, const Vec3<T>& q, const ShapeSize& s) {
  switch (shape) {
    case Shape::kSphere:
      return sphere_distance(q, s);
    case Shape::kSegment:
      return segment_distance(q, s);
    case Shape::kBox:
      return box_distance(q, s);
    case Shape::kCylinder:
      return cylinder_distance(q, s);
    case Shape::kTorus:
      return torus_distance(q, s);
    case Shape::kEllipsoid:
      return ellipsoid_distance(q, s);
  }
  return T(0.0);
}

// The field of a `positive` primitive at signed distance d with range h (scene.proto, Primitives).
inline constexpr double kR0 = 0.45420201894740647;  // sqrt(1 - 2^(-1/3))

template <class T>
T soften(const T& d, double h) {
  using std::max, std::min;
  const T r = min(max(d * ((1 - kR0) / h) + kR0, T(0.0)), T(1.0));
  const T v = T(1.0) - r * r;
  return v * v * v;
}

}  // namespace isofield::blobtree
