// What [G] promises of its blends' shapes: no bulge along aligned parts, no blending at a distance, no absorbed detail,
// and contact surfaces that deform only where they touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/device_field.h"
#include "support/paper_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using test_support::figure;
using test_support::Join;
using test_support::join_node;
using test_support::kSoftRadius;
using test_support::soft_segment;
using test_support::soft_sphere;

struct Ray {
  dvec3 origin, direction;
};

struct Model {
  v1::Scene scene;
  reference::Evaluator exact;

  explicit Model(const std::string& nodes)
      : scene(test_support::scene_of_nodes("[" + nodes + "]")), exact(test_support::read_or_die(scene)) {}
  Model(const std::string& operands, Join join, const std::vector<std::string>& children)
      : Model(operands + "," + join_node(join, children)) {}

  // Where each ray leaves the solid; NaN where it does not before `reach`.
  std::vector<double> exits(const std::vector<Ray>& rays, double reach) const {
    std::vector<double> found;
    for (const Ray& r : rays) {
      const auto t = test_support::exit_distance([&](const dvec3& p) { return exact.value(p); }, r.origin, r.direction,
                                                 reach);
      found.push_back(t.value_or(std::nan("")));
    }
    return found;
  }

  // The largest difference of these exits from the device's own.
  double device_error(const std::vector<Ray>& rays, const std::vector<double>& exits) const {
    const DeviceField field(scene);
    constexpr double kBracket = 1e-3;
    std::vector<double> low, high;
    for (const double t : exits) {
      low.push_back(t - kBracket);
      high.push_back(t + kBracket);
    }
    for (int i = 0; i < 22; ++i) {
      std::vector<dvec3> points;
      for (std::size_t r = 0; r < rays.size(); ++r) {
        const double t = std::isnan(exits[r]) ? 0 : (low[r] + high[r]) / 2;
        points.push_back(rays[r].origin + rays[r].direction * t);
      }
      const std::vector<double> values = field.values(points);
      for (std::size_t r = 0; r < rays.size(); ++r) (values[r] > 0.5 ? low : high)[r] = (low[r] + high[r]) / 2;
    }
    double worst = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!std::isnan(exits[r])) worst = std::max(worst, std::abs(low[r] - exits[r]));
    }
    return worst;
  }
};

TEST(PaperBulge, AlignedCylindersKeepTheirRadius) {
  const std::string operands =
      soft_segment("left", {-3, 0, 0}, {0.5, 0, 0}, 1) + "," + soft_segment("right", {-0.5, 0, 0}, {3, 0, 0}, 1);
  std::vector<Ray> rays;
  for (int i = -200; i <= 200; ++i) {
    for (const double angle : {0.0, 0.7, 2.1}) {
      rays.push_back({{0.0125 * i, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
    }
  }
  for (const Join join : {Join::kCamel, Join::kOrganic, Join::kContact, Join::kSum}) {
    const Model model(operands, join, {"left", "right"});
    const std::vector<double> exits = model.exits(rays, 2);
    double most = 0;
    for (const double t : exits) most = std::max(most, std::abs(t / kSoftRadius - 1));
    figure(std::string(text(join)) + ": radius off by at most", 100 * most, "%");
    const double error = model.device_error(rays, exits);
    figure(std::string(text(join)) + ": device off the reference by at most", error);
    EXPECT_LE(error, 1e-5);
    if (join == Join::kSum) {
      EXPECT_GT(most, 0.2);
    } else if (join == Join::kCamel) {
      EXPECT_LE(most, 0.002);
    }
  }
}

// Two raw soft spheres of radius 1 whose surfaces are `gap` apart (negative: they overlap), along x.
struct TwoSpheres {
  double distance;  // of the centres
  std::string operands;

  explicit TwoSpheres(double gap)
      : distance(2 * kSoftRadius + gap),
        operands(soft_sphere("first", {0, 0, 0}, 1) + "," + soft_sphere("second", {distance, 0, 0}, 1)) {}
};

struct Movement {
  double first_order = 0;  // (g - 0.5) / |grad f1| on the surface of a sphere
  double radial = 0;       // of the blend's surface from the nearer sphere's
  double device_first_order = 0;
  double device_error = 0;  // of the radial one
};

// In parts of the radius.
Movement movement(double gap, Join join) {
  const TwoSpheres pair(gap);
  const Model model(pair.operands, join, {"first", "second"});
  std::vector<Ray> rays;
  std::vector<dvec3> on_sphere;
  // Densest towards the other sphere.
  for (int i = 0; i <= 600; ++i) {
    const double angle = std::numbers::pi * std::pow(i / 600.0, 2);
    rays.push_back({{0, 0, 0}, {std::cos(angle), std::sin(angle), 0}});
    on_sphere.push_back(rays.back().direction * kSoftRadius);
  }
  Movement m;
  const Model alone(soft_sphere("first", {0, 0, 0}, 1));
  const double slope = length(alone.exact.evaluate(on_sphere[0]).gradient);
  std::vector<dvec3> rounded;
  for (const dvec3& p : on_sphere) {
    rounded.push_back(rounded_to_float(p));
    m.first_order = std::max(m.first_order, std::abs(model.exact.value(p) - 0.5) / slope / kSoftRadius);
  }
  const std::vector<double> values = DeviceField(model.scene).values(rounded);
  const std::vector<double> values_alone = DeviceField(alone.scene).values(rounded);
  for (std::size_t i = 0; i < values.size(); ++i) {
    m.device_first_order =
        std::max(m.device_first_order, std::abs(values[i] - values_alone[i]) / slope / kSoftRadius);
  }
  std::vector<double> exits = model.exits(rays, 2);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    // Beyond the plane of symmetry it is the other sphere's.
    if (exits[r] * rays[r].direction.x > pair.distance / 2) exits[r] = std::nan("");
    if (!std::isnan(exits[r])) m.radial = std::max(m.radial, std::abs(exits[r] / kSoftRadius - 1));
  }
  m.device_error = model.device_error(rays, exits) / kSoftRadius;
  return m;
}

Movement reported(double gap, Join join) {
  const Movement m = movement(gap, join);
  const std::string where = std::string(text(join)) + " gap " + std::to_string(gap).substr(0, 5);
  figure(where + ": first-order movement", 100 * m.first_order, "%");
  figure(where + ": radial movement", 100 * m.radial, "%");
  figure(where + ": first-order movement on the device", 100 * m.device_first_order, "%");
  figure(where + ": device off the reference by at most", m.device_error);
  return m;
}

constexpr double kGaps[] = {0.001, 0.01, 0.1, 0.2};

TEST(PaperLocality, DISABLED_Explore) {
  for (const Join join : {Join::kCamel, Join::kOrganic, Join::kSum, Join::kContact}) {
    for (const double gap : {0.001, 0.01, 0.03, 0.1, 0.2}) reported(gap, join);
  }
}

TEST(PaperAbsorption, ASpikeKeepsItsLength) {
  const double tip = 0.8 + 0.1 * kSoftRadius, length = tip - kSoftRadius;
  const std::string operands =
      soft_sphere("ball", {0, 0, 0}, 1) + "," + soft_segment("spike", {0.3, 0, 0}, {0.8, 0, 0}, 0.1);
  for (const Join join : {Join::kMax, Join::kCamel, Join::kOrganic, Join::kContact, Join::kSum}) {
    const Model model(operands, join, {"ball", "spike"});
    const std::vector<Ray> rays{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {-1, 0, 0}}};
    const std::vector<double> exits = model.exits(rays, 2);
    figure(std::string(text(join)) + ": length", 100 * (exits[0] - exits[1]) / length, "%");
    for (double x : {0.5, 0.6, 0.7}) {
      figure(std::string(text(join)) + ": width at " + std::to_string(x),
             model.exits({{{x, 0, 0}, {0, 1, 0}}}, 2)[0] / (0.1 * kSoftRadius));
    }
    figure(std::string(text(join)) + ": device off", model.device_error(rays, exits));
  }
}

}  // namespace
}  // namespace isofield::gpu_test
