// The limits of lengths and coordinates. Beyond them float32 squares would be infinite, or vanish.
#pragma once

namespace isofield::base {

inline constexpr double kMaxCoordinate = 1e9;
inline constexpr double kMinLength = 1e-9;

}  // namespace isofield::base
