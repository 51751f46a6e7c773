#include "integration/ball.h"

#include <algorithm>
#include <cmath>

#include "support/random_scene.h"
#include "support/worst.h"

namespace isofield::integration_test {
namespace {

const double kR0 = std::sqrt(1 - std::pow(2, -1.0 / 3));

}  // namespace

v1::Scene Ball::scene() const {
  v1::Scene scene;
  v1::Node& node = *scene.add_nodes();
  node.set_name("ball");
  for (const double x : center) node.mutable_sphere()->add_center(x);
  node.mutable_sphere()->set_radius(radius);
  node.mutable_sphere()->set_range(range);
  return scene;
}

double Ball::ratio(const float* point, double& distance) const {
  distance = std::hypot(point[0] - center[0], point[1] - center[1], point[2] - center[2]);
  return std::clamp(kR0 + (1 - kR0) * (distance - radius) / range, 0.0, 1.0);
}

double Ball::value(const float* point) const {
  double distance = 0;
  const double r = ratio(point, distance);
  return std::pow(1 - r * r, 3);
}

std::array<double, 3> Ball::gradient(const float* point) const {
  double distance = 0;
  const double r = ratio(point, distance);
  if (r <= 0 || r >= 1) return {};
  const double slope = -6 * r * (1 - r * r) * (1 - r * r) * (1 - kR0) / range;
  return {slope * (point[0] - center[0]) / distance, slope * (point[1] - center[1]) / distance,
          slope * (point[2] - center[2]) / distance};
}

Ball::Errors Ball::errors(std::span<const float> xyz, std::span<const float> results) const {
  const std::size_t count = xyz.size() / 3, columns = results.size() / std::max<std::size_t>(count, 1);
  // |df/dr| has its maximum at r = 1 / sqrt(5).
  const double steepest = 6 / std::sqrt(5) * 0.64 * (1 - kR0) / range;
  Errors errors;
  for (std::size_t i = 0; i < count; ++i) {
    const float* const p = &xyz[3 * i];
    const float* const result = &results[columns * i];
    test_support::keep_worst(errors.value, std::abs(result[0] - value(p)));
    if (columns < 4) continue;
    const std::array<double, 3> g = gradient(p);
    test_support::keep_worst(errors.gradient,
                             std::hypot(result[1] - g[0], result[2] - g[1], result[3] - g[2]) / steepest);
  }
  return errors;
}

std::vector<float> points_around(const Ball& ball, std::uint64_t first, std::size_t count) {
  test_support::Random random(first);
  std::vector<float> xyz;
  xyz.reserve(3 * count);
  while (xyz.size() < 3 * count) {
    const blobtree::dvec3 direction = random.point(-1, 1);
    const double norm = length(direction);
    if (norm < 0.1 || norm > 1) continue;
    const double distance = random.number(0, ball.radius + 2 * ball.range) / norm;
    xyz.insert(xyz.end(), {static_cast<float>(ball.center[0] + direction.x * distance),
                           static_cast<float>(ball.center[1] + direction.y * distance),
                           static_cast<float>(ball.center[2] + direction.z * distance)});
  }
  return xyz;
}

}  // namespace isofield::integration_test
