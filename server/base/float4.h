// Float4 is four float32 numbers, like GLSL's vec4. Parameters lie in the device's buffers in this unit.
#pragma once

#include <array>

namespace isofield::base {

using Float4 = std::array<float, 4>;

// Rounds a number to float32.
inline float f32(double x) {
  return static_cast<float>(x);
}

}  // namespace isofield::base
