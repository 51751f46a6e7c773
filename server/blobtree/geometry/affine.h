// Affine maps of space, in double precision.
#pragma once

#include <array>
#include <optional>

#include "blobtree/geometry/vec3.h"

namespace isofield::blobtree {

// p -> linear p + offset; linear is stored by rows.
struct Affine {
  std::array<dvec3, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  dvec3 offset{};

  dvec3 vector(const dvec3& v) const { return {dot(linear[0], v), dot(linear[1], v), dot(linear[2], v)}; }
  dvec3 point(const dvec3& p) const { return vector(p) + offset; }
  // this after other.
  Affine after(const Affine& other) const;
  // Empty when the linear part is singular.
  std::optional<Affine> inverse() const;
  // The least and the largest factor by which the linear part stretches a vector (its singular values).
  struct Stretch {
    double least, most;
  };
  Stretch stretch() const;
  // Whether the linear part keeps angles (to about `tolerance` radians): it turns, mirrors and scales alike in all
  // directions.
  bool is_similarity(double tolerance) const;
  // The lower triangle L, by rows, with L L^T = A A^T of the linear part A. A gradient g after the map is A^T g before
  // it, so L^T g has the lengths and angles that the gradient has before the map.
  using LowerTriangle = std::array<double, 6>;
  LowerTriangle gradient_frame() const;

  static Affine translation(const dvec3& t) { return {.offset = t}; }
  static Affine scale(const dvec3& s) { return {{{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}}, {}}; }
  // Axis of any length but 0, angle in radians.
  static Affine rotation(const dvec3& axis, double angle);
  // A rigid map that takes the z axis to `direction` (any length but 0) and the origin to `origin`.
  static Affine frame(const dvec3& origin, const dvec3& direction);
};

}  // namespace isofield::blobtree
