// Tests the claim of [G] that blends of blends stay smooth. A reflection line follows the normal. Its second derivative
// along a path on the surface must have no jump, so differences between neighbouring samples must shrink with their
// distance. The test runs in double precision on the reference, because float32 is too coarse for second differences.
// Other tests compare the device with the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "reference/evaluator.h"
#include "support/paper_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using reference::Evaluator;
using reference::Sample;
using test_support::figure;
using test_support::Join;
using test_support::join_node;
using test_support::soft_sphere;

using Solid = std::function<Sample(const dvec3&)>;

// Four spheres in each other's range; their own fields have all derivatives.
const std::vector<std::string>& spheres() {
  static const std::vector<std::string> all{soft_sphere("a", {0, 0, 0}, 1.5), soft_sphere("b", {0.7, 0.1, 0.1}, 1),
                                            soft_sphere("c", {-0.3, 0.7, 0}, 1),
                                            soft_sphere("d", {0.25, 0.65, 0.1}, 0.9)};
  return all;
}

Evaluator evaluator(const std::string& nodes) {
  return Evaluator(test_support::read_or_die(test_support::scene_of_nodes("[" + nodes + "]")));
}

// Makes three blends, one after another.
template <class Node>
Solid three_blends(const Node& node) {
  std::string nodes;
  for (const std::string& sphere : spheres()) nodes += sphere + ",";
  const Evaluator e =
      evaluator(nodes + node({"a", "b"}, "one") + "," + node({"one", "c"}, "two") + "," + node({"two", "d"}, "three"));
  return [e](const dvec3& p) { return e.evaluate(p); };
}

Solid three_barthe_blends() {
  return three_blends([](const std::vector<std::string>& children, const std::string& name) {
    return R"({"name": ")" + name + R"(", "barthe": {"children": [")" + children[0] + R"(", ")" + children[1] +
           R"("], "theta1": 15, "theta2": 15}})";
  });
}

// Returns a reflection line along the curve in which a plane cuts the surface, at `count` angles around a point inside.
std::vector<double> reflections(const Solid& solid, int count) {
  const dvec3 centre{0, 0, 0.1}, view{0.36, 0.48, 0.8}, pattern{0.6, 0, 0.8};
  std::vector<double> line;
  double t = *test_support::exit_distance([&](const dvec3& p) { return solid(p).value; }, centre, {1, 0, 0}, 2);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const dvec3 direction{std::cos(angle), std::sin(angle), 0};
    Sample s;
    for (int step = 0; step < 12; ++step) {
      s = solid(centre + direction * t);
      const double move = (0.5 - s.value) / dot(s.gradient, direction);
      t += move;
      if (std::abs(move) < 1e-14) break;
    }
    EXPECT_NEAR(s.value, 0.5, 1e-6);  // see kSteps
    const dvec3 normal = s.gradient * (-1 / length(s.gradient));
    line.push_back(dot(view - normal * (2 * dot(view, normal)), pattern));
  }
  return line;
}

// Returns the largest difference between neighbouring second derivatives by divided differences.
double largest_jump(const std::vector<double>& line) {
  const std::size_t n = line.size();
  const double h = 2 * std::numbers::pi / static_cast<double>(n);
  std::vector<double> second;
  for (std::size_t i = 0; i < n; ++i) {
    second.push_back((line[(i + 1) % n] - 2 * line[i] + line[(i + n - 1) % n]) / (h * h));
  }
  double jump = 0;
  for (std::size_t i = 0; i < n; ++i) jump = std::max(jump, std::abs(second[(i + 1) % n] - second[i]));
  return jump;
}

// The steps are h, h/2, h/4 and h/8 with h = 1.4 degrees. Much finer ones see that the functions of [G] are not flat to
// the last bit: E(0) = 2.6e-7 and E'(0) = 1.1e-5 instead of 0, so the blend's gradient steps by about 1e-5 (a
// thousandth of a degree) where its region begins. That is below float32, but a second difference at h = 0.05 degrees
// magnifies it by a million.
constexpr int kSteps[] = {250, 500, 1000, 2000};

std::vector<double> reported_jumps(const std::string& name, const Solid& solid) {
  std::vector<double> jumps;
  for (const int count : kSteps) {
    jumps.push_back(largest_jump(reflections(solid, count)));
    figure(name + ": largest jump at " + std::to_string(count) + " samples", jumps.back());
  }
  return jumps;
}

TEST(PaperSmoothness, ReflectionLinesOfThreeBlendsHaveASecondDerivative) {
  for (const Join join : {Join::kCamel, Join::kOrganic}) {
    const auto jumps =
        reported_jumps(text(join), three_blends([&](const std::vector<std::string>& children, const std::string& name) {
                         return join_node(join, children, name);
                       }));
    // The jump is proportional to the step, once the step resolves the curve.
    EXPECT_LT(jumps[1], 0.8 * jumps[0]) << text(join);
    EXPECT_LT(jumps[2], 0.6 * jumps[1]) << text(join);
    EXPECT_LT(jumps[3], 0.55 * jumps[2]) << text(join);
  }
}

TEST(PaperSmoothness, ReflectionLinesOfBarthesBlendHaveNone) {
  const auto jumps = reported_jumps("Barthe", three_barthe_blends());
  for (int i = 1; i < 4; ++i) EXPECT_GT(jumps[i], jumps[i - 1]);
}

}  // namespace
}  // namespace isofield::gpu_test
