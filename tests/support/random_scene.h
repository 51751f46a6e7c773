// Makes random valid scenes of about unit scale: coordinates lie within about [-2, 2], radii and ranges within [0.1,
// 0.8], so that most primitives overlap others.
#pragma once

#include <cstdint>
#include <random>

#include "blobtree/geometry/vec3.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::test_support {

// A random generator that gives the same numbers with every standard library, unlike std::uniform_real_distribution.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Returns a number within [low, high[.
  double number(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  // Returns an integer within [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return number(0, 1) < probability; }
  // Returns a point within the box [low, high]^3.
  blobtree::dvec3 point(double low, double high) {
    const double x = number(low, high), y = number(low, high), z = number(low, high);
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

struct RandomSceneOptions {
  // The approximate number of nodes; at least 1.
  int nodes = 40;
  // Allows operators that cut pieces away (all but sum, max and the gradient-based blend), and forms that do.
  bool cuts = true;
  // Allows signed fields, with their operators and the conversions between the laws, and the classic blends of positive
  // fields.
  bool all_operators = true;
  bool transforms = true;
  // Uses some nodes twice.
  bool sharing = true;
};

// Makes a scene from a seed. All kinds of nodes but custom appear, and all openings (presets, changed presets, custom)
// and silhouettes, given enough nodes. A half-space only cuts, so that the solid is bounded. The nodes lie in any
// order, and some have names.
v1::Scene random_scene(std::uint64_t seed, const RandomSceneOptions& options = {});

}  // namespace isofield::test_support
