#include "operators/steered.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "operators/tables.h"

namespace isofield::operators {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// A blend that opens by 45 degrees is the sharp union. From this angle on it is sharper than cells show.
constexpr double kSharp = 44 * kDegree;

}  // namespace

bool is_sharp(const Opening& opening) {
  for (int degrees = 30; degrees <= 150; degrees += 5) {
    if (opening.theta(degrees * std::numbers::pi / 180).v > kSharp) return true;
  }
  return false;
}

Float4 steered_record(const Opening& opening, std::uint32_t blend, const Use& use, Tables& tables) {
  return {std::bit_cast<float>(tables.opening(opening)), std::bit_cast<float>(blend),
          f32(std::tan(opening.theta_min())), f32(use.length)};
}

std::uint32_t volume_word(std::uint32_t slot, int size) {
  return slot | static_cast<std::uint32_t>(size) << 8;
}

Interval volume_bound(const Interval& a, const Interval& b, int size, double growth) {
  // The operator is interpolated between nodes that are at most a step further. Each node lies between the maximum and
  // the bound that `growth` gives.
  const double high = std::max(a.hi, b.hi);
  const double step = std::max(high, 1.0) / (size - 1);
  return {std::max(std::max(a.lo, b.lo) - step, 0.0), (high + step) * (1 + growth) + base::kValueRoom};
}

}  // namespace isofield::operators
