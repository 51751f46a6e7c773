// The scene that has a formula: one sphere.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield::integration_test {

struct Ball {
  std::array<double, 3> center{0.25, -0.5, 0.125};
  double radius = 1, range = 0.5;

  v1::Scene scene() const;
  // (1 - r^2)^3 with r = clamp(r0 + (1 - r0) d / range, 0, 1), r0 = sqrt(1 - 2^(-1/3)); and its gradient.
  double value(const float* point) const;
  std::array<double, 3> gradient(const float* point) const;
  // The largest errors of results [n, 1] or [n, 4] at points [n, 3]; of gradients relative to the steepest one there
  // is.
  struct Errors {
    double value = 0, gradient = 0;
  };
  Errors errors(std::span<const float> xyz, std::span<const float> results) const;

 private:
  double ratio(const float* point, double& distance) const;
};

// Deterministic points around the ball, `first` being the number of the first one: a third of them inside, a third in
// the range, a third beyond.
std::vector<float> points_around(const Ball& ball, std::uint64_t first, std::size_t count);

}  // namespace isofield::integration_test
