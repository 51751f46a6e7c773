// Random valid scenes of about unit scale: coordinates within about [-2, 2], radii and ranges within [0.1, 0.8], so
// that most primitives overlap others.
#pragma once

#include <cstdint>
#include <random>

#include "blobtree/geometry/vec3.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::test_support {

// The same numbers with every standard library, unlike those of std::uniform_real_distribution.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Within [low, high[.
  double number(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  // Within [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return number(0, 1) < probability; }
  // Within the box [low, high]^3.
  blobtree::dvec3 point(double low, double high) {
    const double x = number(low, high), y = number(low, high), z = number(low, high);
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

struct RandomSceneOptions {
  // About as many nodes; at least 1.
  int nodes = 40;
  // Operators other than sum, max and the gradient-based blend, which cut pieces away, and forms that do.
  bool cuts = true;
  // Signed fields, with their operators and the conversions between the laws; the classic blends of positive fields.
  bool all_operators = true;
  bool transforms = true;
  // Some nodes are used twice.
  bool sharing = true;
};

// Every kind of node, opening (presets, changed presets, custom) and silhouette appears, given enough nodes. Nodes lie
// in any order; some have names.
v1::Scene random_scene(std::uint64_t seed, const RandomSceneOptions& options = {});

}  // namespace isofield::test_support
