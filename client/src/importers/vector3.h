#pragma once

#include <array>
#include <cmath>

namespace isofield {

// A point or a direction in space.
using Vector3 = std::array<double, 3>;

inline Vector3 add(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 subtract(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 scale(const Vector3& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& a) {
  return std::hypot(a[0], a[1], a[2]);
}
inline double distance(const Vector3& a, const Vector3& b) {
  return length(subtract(a, b));
}
// The point at t on the line from a (t = 0) to b (t = 1).
inline Vector3 between(const Vector3& a, const Vector3& b, double t) {
  return add(a, scale(subtract(b, a), t));
}

}  // namespace isofield
