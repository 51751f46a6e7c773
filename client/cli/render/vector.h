#pragma once

#include <cmath>

namespace isofield {

// A vector in model or camera space, as the renderer needs it.
struct Vector {
  float x = 0, y = 0, z = 0;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const Vector& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vector operator*(const Vector& a, const Vector& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
};

inline float dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector normalize(const Vector& a) {
  const float length = std::sqrt(dot(a, a));
  return length > 0 ? a * (1 / length) : Vector{0, 0, 1};
}
inline Vector mix(const Vector& a, const Vector& b, float t) {
  return a * (1 - t) + b * t;
}

}  // namespace isofield
