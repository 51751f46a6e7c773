// Four float32 numbers, the unit in which parameters lie in buffers of the device (GLSL's vec4).
#pragma once

#include <array>

namespace isofield::base {

using Float4 = std::array<float, 4>;

// Rounds a number to float32.
inline float f32(double x) {
  return static_cast<float>(x);
}

}  // namespace isofield::base
