// Vectors of numbers that carry derivatives, such as Dual and Jet. GLM cannot hold these, since it takes only built-in
// floating-point types.
#pragma once

#include <cmath>

namespace isofield::reference {

template <class T>
struct Vec3 {
  using value_type = T;

  T x{}, y{}, z{};

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, const T& s) { return {a.x * s, a.y * s, a.z * s}; }
  bool operator==(const Vec3&) const = default;
};

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
T length(const Vec3<T>& a) {
  return sqrt(dot(a, a));
}

}  // namespace isofield::reference
