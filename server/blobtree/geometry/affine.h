// Affine is an affine map of space in double precision. Transforms of a scene and the placement of leaves are such
// maps.
#pragma once

#include <array>
#include <optional>

#include "blobtree/geometry/vec3.h"

namespace isofield::blobtree {

// The map takes p to linear p + offset. The matrix `linear` is stored by rows.
struct Affine {
  std::array<dvec3, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  dvec3 offset{};

  dvec3 vector(const dvec3& v) const { return {dot(linear[0], v), dot(linear[1], v), dot(linear[2], v)}; }
  dvec3 point(const dvec3& p) const { return vector(p) + offset; }
  // Returns the map that applies `other` first and then this one.
  Affine after(const Affine& other) const;
  // Returns nothing when the linear part is singular.
  std::optional<Affine> inverse() const;
  // Stretch holds the least and the largest factor by which the linear part stretches a vector (its singular values).
  struct Stretch {
    double least, most;
  };
  Stretch stretch() const;
  // Returns whether the linear part keeps angles, to about `tolerance` radians. Such a map only turns, mirrors and
  // scales equally in all directions.
  bool is_similarity(double tolerance) const;
  // Returns the lower triangle L, by rows, with L L^T = A A^T, where A is the linear part. If g is a gradient after the
  // map, it is A^T g before the map, and L^T g has the same lengths and angles as A^T g.
  using LowerTriangle = std::array<double, 6>;
  LowerTriangle gradient_frame() const;

  static Affine translation(const dvec3& t) { return {.offset = t}; }
  static Affine scale(const dvec3& s) { return {{{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}}, {}}; }
  // The axis may have any length but 0. The angle is in radians.
  static Affine rotation(const dvec3& axis, double angle);
  // Returns a rigid map that takes the z axis to `direction` (of any length but 0) and the origin to `origin`.
  static Affine frame(const dvec3& origin, const dvec3& direction);
};

}  // namespace isofield::blobtree
