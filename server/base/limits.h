// The limits of lengths and coordinates, in model units. Beyond them squares in float32 would be infinite or vanish.
#pragma once

namespace isofield::base {

inline constexpr double kMaxCoordinate = 1e9;
inline constexpr double kMinLength = 1e-9;

}  // namespace isofield::base
