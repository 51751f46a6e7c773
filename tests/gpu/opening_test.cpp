// Compares opening functions on the device with exact arithmetic: at a given angle, and at the angle of two gradients.
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "blobtree/primitives/falloff.h"
#include "engine/points/operator_evaluator.h"
#include "gpu/device_field.h"
#include "operators/gradient_blend.h"
#include "support/paper_scene.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using operators::Opening;

constexpr double kPi = std::numbers::pi;

engine::OperatorEvaluator& evaluator() {
  static engine::OperatorEvaluator evaluator(device(), kernels(), volumes());
  return evaluator;
}

// Returns angles within [0, pi]: some anywhere, some on either ramp, and most of those close to the ramp's ends.
std::vector<float> angles_of(const Opening& o, test_support::Random& random) {
  std::vector<float> alphas{0, static_cast<float>(kPi)};
  const double ends[] = {o.alpha0, o.alpha1, o.alpha2};
  for (int i = 0; i < 500; ++i) {
    alphas.push_back(static_cast<float>(random.number(0, kPi)));
    for (int side = 0; side < 2; ++side) {
      const double low = ends[side], span = ends[side + 1] - low;
      alphas.push_back(static_cast<float>(low + span * random.number(0, 1)));
      const double near = span * std::pow(10.0, random.number(-6, 0));
      alphas.push_back(static_cast<float>(low + near));
      alphas.push_back(static_cast<float>(low + span - near));
    }
  }
  for (const double end : ends) {
    for (const float to : {0.0f, 4.0f}) {
      float alpha = static_cast<float>(end);
      for (int i = 0; i < 3; ++i, alpha = std::nextafter(alpha, to)) alphas.push_back(alpha);
    }
  }
  for (float& alpha : alphas) alpha = std::clamp(alpha, 0.0f, std::nextafter(static_cast<float>(kPi), 0.0f));
  return alphas;
}

struct Errors {
  double theta = 0;
  double slope = 0;  // relative to the steepest slope at the same side of alpha1
};

Errors errors_at(const Opening& o, const std::vector<float>& alphas) {
  std::vector<float> results(2 * alphas.size());
  EXPECT_TRUE(evaluator().evaluate_opening(o, alphas, results).ok());
  double steepest[2] = {1e-6, 1e-6};
  const auto side = [&](float alpha) { return alpha < o.alpha1 ? 0 : 1; };
  for (const float alpha : alphas) {
    steepest[side(alpha)] = std::max(steepest[side(alpha)], std::abs(o.theta(alpha).d1));
  }
  Errors worst;
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const operators::Curve exact = o.theta(alphas[i]);
    worst.theta = std::max(worst.theta, std::abs(results[2 * i] - exact.v));
    worst.slope = std::max(worst.slope, std::abs(results[2 * i + 1] - exact.d1) / steepest[side(alphas[i])]);
  }
  return worst;
}

TEST(OpeningOnDevice, IsExactForEveryLegalSlopeAndRamp) {
  test_support::Random random(5);
  Errors worst;
  int openings = 0;
  for (const double w0 : {0.05, 0.09, 0.3, 1.0, 3.0, 8.0, 20.0}) {
    for (const double w1 : {0.05, 1.0, 20.0}) {
      for (const double ramp : {operators::kLeastRamp, kPi / 180, 0.3, 1.0}) {
        for (const double alpha1 : {ramp, 0.5 * kPi, kPi - 2e-3, random.number(ramp, kPi - 2e-3)}) {
          const double alpha0 = std::max(alpha1 - ramp, 0.0), alpha2 = std::min(alpha1 + 1.7 * ramp, kPi);
          Opening o{alpha0, alpha1, alpha2, kPi / 4, 0, random.number(0.2, kPi / 4), w0, w1};
          if (openings % 3 == 1) o.theta0 = 0, o.theta1 = kPi / 4;
          const Errors e = errors_at(o, angles_of(o, random));
          EXPECT_LE(e.theta, 1e-6) << "w " << w0 << " " << w1 << " ramp " << ramp << " alpha1 " << alpha1;
          EXPECT_LE(e.slope, 4e-6) << "w " << w0 << " " << w1 << " ramp " << ramp << " alpha1 " << alpha1;
          worst = {std::max(worst.theta, e.theta), std::max(worst.slope, e.slope)};
          ++openings;
        }
      }
    }
  }
  test_support::figure("openings", openings);
  test_support::figure("largest error of theta", worst.theta);
  test_support::figure("largest error of its slope over the steepest", worst.slope);
}

TEST(OpeningOnDevice, FollowsTheCubicsOfItsSamples) {
  test_support::Random random(6);
  Errors worst;
  for (const int samples : {3, 4, 10, 181, 4096}) {
    for (const bool is_step : {false, true}) {
      std::vector<double> theta;
      for (int i = 0; i < samples; ++i) {
        theta.push_back(is_step ? (i % 7 < 3 ? 0 : kPi / 4) : random.number(0, kPi / 4));
      }
      Opening o{};
      o.samples = operators::SampledCurve::even(0, kPi, theta);
      std::vector<float> alphas{0, std::nextafter(static_cast<float>(kPi), 0.0f)};
      for (int i = 0; i < 20'000; ++i) alphas.push_back(static_cast<float>(random.number(0, kPi)));
      const Errors e = errors_at(o, alphas);
      EXPECT_LE(e.theta, 1e-6) << samples;
      EXPECT_LE(e.slope, 4e-6) << samples;
      worst = {std::max(worst.theta, e.theta), std::max(worst.slope, e.slope)};
    }
  }
  test_support::figure("largest error of theta", worst.theta);
  test_support::figure("largest error of its slope over the steepest", worst.slope);
}

// A difference turns the first operand's gradient round, so its angle is pi - alpha, which float32 must not round.
TEST(OpeningOnDevice, ADifferenceIsExactAtItsAngle) {
  const operators::Opening opening{kPi - 2.5e-3, kPi - 1.5e-3, kPi, kPi / 4, 0, kPi / 4, 0.3, 1};
  const operators::Operator op(operators::Gradient{.opening = opening}, operators::Form::kDifference);
  test_support::Random random(8);
  std::vector<float> rows;
  for (int i = 0; i < 2000; ++i) {
    rows.insert(rows.end(), {0.55f, 0.5f, static_cast<float>(random.number(0, i % 2 ? 3e-3 : kPi))});
  }
  std::vector<float> results(rows.size() / 3 * 4);
  ASSERT_TRUE(evaluator()
                  .evaluate(std::make_shared<const operators::Operator>(op), 2, engine::Steering::kAlpha, rows, results)
                  .ok());
  for (std::size_t i = 0; i < rows.size() / 3; ++i) {
    const operators::Curve theta = opening.theta(kPi - rows[3 * i + 2]);
    const operators::Blend u = operators::gradient_blend(1 - double{rows[3 * i]}, rows[3 * i + 1], theta.v, {});
    ASSERT_NEAR(results[4 * i], 1 - u.g, 2e-6) << rows[3 * i + 2];
    ASSERT_NEAR(results[4 * i + 3], u.gt * theta.d1, 1e-5 * std::max(1.0, std::abs(theta.d1))) << rows[3 * i + 2];
  }
}

std::string opening_json(const Opening& o) {
  constexpr double kDegree = kPi / 180;
  return absl::StrFormat(
      R"({"alpha0": %.17g, "alpha1": %.17g, "alpha2": %.17g, "theta0": %.17g, "theta1": %.17g, "theta2": %.17g,
          "w0": %g, "w1": %g})",
      o.alpha0 / kDegree, o.alpha1 / kDegree, o.alpha2 / kDegree, o.theta0 / kDegree, o.theta1 / kDegree,
      o.theta2 / kDegree, o.w0, o.w1);
}

// The scene has two soft spheres. The points lie beside the line through their centres, where gradients are nearly
// parallel or opposed: the cosine of their angle is within float32's rounding of 1 or -1.
TEST(OpeningOnDevice, TheAngleOfGradientsIsGoodToRounding) {
  const dvec3 centres[] = {{0, 0, 0}, {0.3, 0, 0}};
  const Opening openings[] = {{0, 1e-3, 2e-3, kPi / 4, 0, kPi / 4, 0.3, 0.3},
                              {0, 2e-2, 4e-2, 0, kPi / 4, 0, 1, 3},
                              {kPi - 2e-3, kPi - 1e-3, kPi, kPi / 4, 0, kPi / 4, 0.3, 0.3},
                              {kPi - 4e-2, kPi - 2e-2, kPi, 0, kPi / 4, 0, 3, 20}};
  test_support::Random random(9);
  double worst_angle = 0, most_steep = 0, worst_gradient = 0;
  for (const Opening& o : openings) {
    const v1::Scene scene = test_support::scene_of_nodes(absl::StrCat(
        "[", test_support::soft_sphere("a", centres[0], 1), ",", test_support::soft_sphere("b", centres[1], 1),
        R"(, {"gradient": {"children": ["a", "b"], "opening": )", opening_json(o), "}}]"));
    std::vector<dvec3> points;
    for (int i = 0; i < 20'000; ++i) {
      const bool is_between = i % 2 == 0;
      const double aside = std::pow(10.0, random.number(-6, -1)), turn = random.number(0, 2 * kPi);
      points.push_back(rounded_to_float({is_between ? random.number(0.05, 0.25) : random.number(0.45, 0.8),
                                         aside * std::cos(turn), aside * std::sin(turn)}));
    }
    const reference::Evaluator exact(test_support::read_or_die(scene));
    const std::vector<reference::Sample> device = DeviceField(scene).samples(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const dvec3 u = points[i] - centres[0], v = points[i] - centres[1];
      const double alpha = std::atan2(length(cross(u, v)), dot(u, v));
      const auto field = [](const dvec3& d) { return std::pow(1 - dot(d, d), 3); };
      const operators::Curve theta = o.theta(alpha);
      const operators::Blend g = operators::gradient_blend(field(u), field(v), theta.v, {});
      const reference::Sample s = exact.evaluate(points[i]);
      ASSERT_NEAR(s.value, g.g, 1e-9);
      // If dg/dalpha is large, all of the value's error comes from the angle.
      const double steep = std::abs(g.gt * theta.d1), error = std::abs(device[i].value - g.g);
      if (steep > 20) worst_angle = std::max(worst_angle, error / steep);
      most_steep = std::max(most_steep, steep);
      ASSERT_LE(error, 1.5e-6 + 4e-7 * steep) << "alpha " << alpha << " slope " << theta.d1;
      // The gradient may be off by float32's error of the rest, by the changes of theta' and dg/dtheta within the
      // angle's rounding, and by the turn of the normal of two nearly parallel gradients. The angle changes by less
      // than 30 a unit of length here.
      constexpr double kRounding = 4e-7;
      const double bend = std::abs(o.theta(alpha + kRounding).d1 - o.theta(std::max(alpha - kRounding, 0.0)).d1);
      const double turn = std::abs(theta.d1) * kRounding;
      const double allowed =
          2e-4 * std::max(1.0, length(s.gradient)) + 30 * (std::abs(g.gt) * (bend + turn / std::sin(alpha)) + turn);
      const double off = length(device[i].gradient - s.gradient);
      worst_gradient = std::max(worst_gradient, off / allowed);
      ASSERT_LE(off, allowed) << "alpha " << alpha << " slope " << theta.d1;
    }
  }
  EXPECT_GT(most_steep, 100);
  test_support::figure("largest dg/dalpha", most_steep);
  test_support::figure("largest error of an angle between gradients, from the blend's value", worst_angle, "rad");
  test_support::figure("largest error of the blend's gradient over what is allowed", worst_gradient);
}

}  // namespace
}  // namespace isofield::gpu_test
