// The scene of one sphere, whose field has a formula with which tests compare answers.
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
  // Return (1 - r^2)^3 with r = clamp(r0 + (1 - r0) d / range, 0, 1), r0 = sqrt(1 - 2^(-1/3)), and its gradient.
  double value(const float* point) const;
  std::array<double, 3> gradient(const float* point) const;
  // Returns the largest errors of results [n, 1] or [n, 4] at points [n, 3]. Errors of gradients are relative to the
  // ball's steepest gradient.
  struct Errors {
    double value = 0, gradient = 0;
  };
  Errors errors(std::span<const float> xyz, std::span<const float> results) const;

 private:
  double ratio(const float* point, double& distance) const;
};

// Returns deterministic points around the ball; `first` is the number of the first point. They lie inside, in the range
// and beyond it.
std::vector<float> points_around(const Ball& ball, std::uint64_t first, std::size_t count);

}  // namespace isofield::integration_test
