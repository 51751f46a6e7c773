// Tests what [G] promises of its blends' shapes: no bulge along aligned parts, no blending at a distance, no absorbed
// detail, and contact surfaces that deform only where they touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "gpu/device_field.h"
#include "support/paper_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using test_support::figure;
using test_support::Join;
using test_support::join_node;
using test_support::keep_worst;
using test_support::kSoftRadius;
using test_support::soft_segment;
using test_support::soft_sphere;

struct Ray {
  dvec3 origin, direction;
  double reach = 2;
};

struct Model {
  v1::Scene scene;
  reference::Evaluator exact;

  explicit Model(const std::string& nodes)
      : scene(test_support::scene_of_nodes("[" + nodes + "]")), exact(test_support::read_or_die(scene)) {}
  Model(const std::string& operands, Join join, const std::vector<std::string>& children)
      : Model(operands + "," + join_node(join, children)) {}

  // Returns the distance at which each ray leaves the solid, or NaN if it does not within its reach.
  std::vector<double> exits(const std::vector<Ray>& rays) const {
    std::vector<double> found;
    for (const Ray& r : rays) {
      const auto t = test_support::exit_distance([&](const dvec3& p) { return exact.value(p); }, r.origin, r.direction,
                                                 r.reach, 60);
      found.push_back(t.value_or(std::nan("")));
    }
    return found;
  }

  // Returns the largest difference of these exits from the device's own.
  double device_error(const std::vector<Ray>& rays, const std::vector<double>& exits) const {
    const DeviceField field(scene);
    constexpr double kBracket = 2e-4;
    std::vector<double> low, high;
    for (const double t : exits) {
      low.push_back(t - kBracket);
      high.push_back(t + kBracket);
    }
    for (int i = 0; i < 20; ++i) {
      std::vector<dvec3> points;
      for (std::size_t r = 0; r < rays.size(); ++r) {
        const double t = std::isnan(exits[r]) ? 0 : (low[r] + high[r]) / 2;
        points.push_back(rays[r].origin + rays[r].direction * t);
      }
      const std::vector<double> values = field.values(points);
      for (std::size_t r = 0; r < rays.size(); ++r) {
        EXPECT_TRUE(std::isfinite(values[r])) << "ray " << r;
        (values[r] > 0.5 ? low : high)[r] = (low[r] + high[r]) / 2;
      }
    }
    double worst = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!std::isnan(exits[r])) keep_worst(worst, std::abs(low[r] - exits[r]));
    }
    return worst;
  }
};

TEST(PaperBulge, AlignedCylindersKeepTheirRadius) {
  const std::string operands =
      soft_segment("left", {-3, 0, 0}, {0.5, 0, 0}, 1) + "," + soft_segment("right", {-0.5, 0, 0}, {3, 0, 0}, 1);
  std::vector<Ray> rays;
  for (int i = -80; i <= 80; ++i) {
    for (const double angle : {0.0, 2.1}) {
      rays.push_back({{0.03125 * i, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
    }
  }
  for (const Join join : {Join::kCamel, Join::kOrganic, Join::kContact, Join::kSum}) {
    const Model model(operands, join, {"left", "right"});
    const std::vector<double> exits = model.exits(rays);
    double most = 0;
    for (const double t : exits) keep_worst(most, std::abs(t / kSoftRadius - 1));
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

// Two raw soft spheres of radius 1 along x, whose surfaces are `gap` apart; a negative gap is an overlap.
struct TwoSpheres {
  double distance;  // between the centres
  std::string operands;

  explicit TwoSpheres(double gap)
      : distance(2 * kSoftRadius + gap),
        operands(soft_sphere("first", {0, 0, 0}, 1) + "," + soft_sphere("second", {distance, 0, 0}, 1)) {}
};

struct Movement {
  double first_order = 0;  // (g - 0.5) / |grad f1| on the surface of a sphere
  double radial = 0;       // distance of the blend's surface from that of the nearer sphere
  double device_first_order = 0;
  double device_error = 0;  // error of the radial movement
  int exits = 0;            // rays that leave the solid within their reach, of 601
};

// Returns the movement relative to the radius.
Movement movement(double gap, Join join) {
  const TwoSpheres pair(gap);
  const Model model(pair.operands, join, {"first", "second"});
  std::vector<Ray> rays;
  std::vector<dvec3> on_sphere;
  // The rays are densest towards the other sphere.
  for (int i = 0; i <= 600; ++i) {
    const double angle = std::numbers::pi * std::pow(i / 600.0, 2);
    // The rays end at the plane of symmetry, beyond which the surface is the other sphere's.
    const double plane = std::cos(angle) > 0 ? pair.distance / 2 / std::cos(angle) : 1;
    rays.push_back({{0, 0, 0}, {std::cos(angle), std::sin(angle), 0}, std::min(plane, 1.0)});
    on_sphere.push_back(rays.back().direction * kSoftRadius);
  }
  Movement m;
  const Model alone(soft_sphere("first", {0, 0, 0}, 1));
  const double slope = length(alone.exact.evaluate(on_sphere[0]).gradient);
  std::vector<dvec3> rounded;
  for (const dvec3& p : on_sphere) {
    rounded.push_back(rounded_to_float(p));
    keep_worst(m.first_order, std::abs(model.exact.value(p) - 0.5) / slope / kSoftRadius);
  }
  const std::vector<double> values = DeviceField(model.scene).values(rounded);
  const std::vector<double> values_alone = DeviceField(alone.scene).values(rounded);
  for (std::size_t i = 0; i < values.size(); ++i) {
    keep_worst(m.device_first_order, std::abs(values[i] - values_alone[i]) / slope / kSoftRadius);
  }
  const std::vector<double> exits = model.exits(rays);
  for (const double t : exits) {
    if (std::isnan(t)) continue;
    ++m.exits;
    m.radial = std::max(m.radial, std::abs(t / kSoftRadius - 1));
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
  figure(where + ": rays that leave the solid", m.exits);
  EXPECT_GE(m.exits, 300) << where << ": a blend may join the spheres, but only before the first one's middle";
  return m;
}

// The bounds are relative to the radius.
struct Bound {
  double gap, first_order, radial;
};

// [G]'s movement is the first-order one. If a blend moves a surface far, its real movement is larger: the blend's own
// slope is smaller where camel's surface goes out to meet the other sphere.
TEST(PaperLocality, CamelHardlyMovesASphereBesideAnother) {
  for (const Bound& b :
       {Bound{0.001, 0.019, 0.07}, Bound{0.01, 0.013, 0.022}, Bound{0.1, 4e-5, 4e-5}, Bound{0.2, 3e-7, 3e-7}}) {
    const Movement m = reported(b.gap, Join::kCamel);
    EXPECT_LE(m.first_order, b.first_order);
    EXPECT_LE(m.radial, b.radial);
    EXPECT_NEAR(m.device_first_order, m.first_order, 1e-6);
    EXPECT_LE(m.device_error, 1e-5);
  }
}

TEST(PaperLocality, OrganicLeavesASphereBesideAnother) {
  for (const double gap : {0.001, 0.01, 0.1, 0.2}) {
    const Movement m = reported(gap, Join::kOrganic);
    EXPECT_LE(m.first_order, 1e-6);
    EXPECT_LE(m.radial, 1e-6);
    EXPECT_LE(m.device_first_order, 1e-6);
    EXPECT_LE(m.device_error, 1e-5);
  }
}

TEST(PaperLocality, SumMovesIt) {
  for (const Bound& b :
       {Bound{0.001, 0.64, 0.34}, Bound{0.01, 0.62, 0.34}, Bound{0.1, 0.43, 0.34}, Bound{0.2, 0.24, 0.34}}) {
    const Movement m = reported(b.gap, Join::kSum);
    EXPECT_NEAR(m.first_order, b.first_order, 0.005);
    EXPECT_NEAR(m.radial, b.radial, 0.01);
    EXPECT_LE(m.device_error, 1e-5);
  }
}

// On the axis the gradients are opposed, and camel is a union. Beside it the angle between them falls faster than the
// fields do, and camel opens. So two spheres that nearly touch join along a ring around the axis, which encloses a
// void.
TEST(PaperLocality, CamelJoinsSpheresAlongARingOnlyWhenTheyNearlyTouch) {
  const auto highest_between = [](double gap, Join join) {
    const TwoSpheres pair(gap);
    const Model model(pair.operands, join, {"first", "second"});
    std::pair<double, double> highest{0, 0};  // value, distance from the axis
    for (int i = 0; i <= 400; ++i) {
      const double away = 0.001 * i;
      const double value = model.exact.value({pair.distance / 2, away, 0});
      EXPECT_TRUE(std::isfinite(value)) << gap << ", " << away;
      highest = std::max(highest, {value, away});
    }
    return highest;
  };
  double low = 0.0001, high = 0.1;
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    (highest_between(middle, Join::kCamel).first > 0.5 ? low : high) = middle;
  }
  figure("camel: largest gap that is bridged", low / kSoftRadius * 100, "% of the radius");
  figure("camel: radius of the bridging ring", highest_between(low, Join::kCamel).second);
  EXPECT_LT(low, 0.01 * kSoftRadius);
  for (const Join join : {Join::kOrganic, Join::kContact}) EXPECT_LT(highest_between(0.0001, join).first, 0.5);
}

TEST(PaperAbsorption, ASpikeKeepsItsLength) {
  // The scenes have thin spikes of several lengths on a ball of radius 0.454.
  for (const double tip : {0.52, 0.6, 0.8}) {
    const double thickness = 0.05, length = tip - kSoftRadius;
    const std::string operands = soft_sphere("ball", {0, 0, 0}, 1) + "," +
                                 soft_segment("spike", {0.3, 0, 0}, {tip - thickness * kSoftRadius, 0, 0}, thickness);
    for (const Join join : {Join::kCamel, Join::kOrganic, Join::kContact, Join::kSum}) {
      const Model model(operands, join, {"ball", "spike"});
      // One ray goes to the ball's far side, which nothing moves.
      const std::vector<Ray> rays{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {-1, 0, 0}}};
      const std::vector<double> exits = model.exits(rays);
      ASSERT_TRUE(std::isfinite(exits[0]) && std::isfinite(exits[1])) << text(join);
      const double kept = (exits[0] - exits[1]) / length;
      figure("spike of " + std::to_string(length).substr(0, 5) + " " + text(join) + ": length", 100 * kept, "%");
      EXPECT_LE(model.device_error(rays, exits), 1e-5);
      if (join == Join::kCamel) {
        EXPECT_NEAR(kept, 1, 0.01);
      }
    }
  }
}

TEST(PaperContact, SurfacesMoveOnlyWhereTheyNearlyTouch) {
  for (const Bound& b : {Bound{0.001, 0.0075, 0.016}, Bound{0.01, 0.0012, 0.0014}, Bound{0.03, 1e-6, 1e-6},
                         Bound{0.1, 1e-6, 1e-6}, Bound{0.2, 1e-6, 1e-6}}) {
    const Movement m = reported(b.gap, Join::kContact);
    EXPECT_LE(m.first_order, b.first_order);
    EXPECT_LE(m.radial, b.radial);
    EXPECT_NEAR(m.device_first_order, m.first_order, 1e-6);
    EXPECT_LE(m.device_error, 1e-5);
  }
}

// Returns the root of a function that is positive at low and not at high.
double root(double low, double high, const std::function<bool(double)>& positive) {
  for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2) {
    (positive(middle) ? low : high) = middle;
  }
  return low;
}

TEST(PaperContact, OverlappingSurfacesFoldWhereTheFieldsAreEqual) {
  const std::string ball = soft_sphere("first", {0, 0, 0}, 1);
  const std::string rod = soft_segment("second", {0.6, -1, 0.1}, {0.7, 1, -0.1}, 0.8);
  const Model first(ball), second(rod), both(ball + "," + rod, Join::kContact, {"first", "second"});
  constexpr double kOffset = 1e-7;
  // The normal must jump across the curve around the axis where f1 = f2 on the surface.
  double least_jump = 180, most_jump = 0;
  for (int i = 0; i < 48; ++i) {
    const double around = 2 * std::numbers::pi * i / 48;
    const auto between = [&](double away) {
      const auto at = [&](double x) { return dvec3{x, away * std::cos(around), away * std::sin(around)}; };
      return at(root(0.1, 0.6, [&](double x) { return first.exact.value(at(x)) > second.exact.value(at(x)); }));
    };
    const dvec3 p = between(root(0, 0.6, [&](double away) { return both.exact.value(between(away)) > 0.5; }));
    EXPECT_NEAR(first.exact.value(p), second.exact.value(p), 1e-12);
    EXPECT_NEAR(both.exact.value(p), 0.5, 1e-9);
    const double jump = test_support::direction_variation(both.exact, p, kOffset) * 180 / std::numbers::pi;
    EXPECT_GT(jump, 10) << around;
    least_jump = std::min(least_jump, jump);
    most_jump = std::max(most_jump, jump);
  }
  // The normal must not jump anywhere else.
  double most_turn = 0, nearest = 1;
  const engine::Mesh mesh = DeviceField(both.scene).mesh(0.03);
  int points = 0;
  for (std::size_t v = 0; v + 2 < mesh.positions.size(); v += 3) {
    const dvec3 p{mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]};
    const double apart = std::abs(first.exact.value(p) - second.exact.value(p));
    if (apart < 1e-5) continue;
    ++points;
    nearest = std::min(nearest, apart);
    keep_worst(most_turn, test_support::direction_variation(both.exact, p, kOffset) * 180 / std::numbers::pi);
  }
  figure("fold: normals jump by at least", least_jump, "deg");
  figure("fold: normals jump by at most", most_jump, "deg");
  figure("elsewhere: vertices", points);
  figure("elsewhere: least |f1 - f2|", nearest);
  figure("elsewhere: normals turn within 1e-7 by at most", most_turn, "deg");
  EXPECT_LT(most_turn, 0.1);
  EXPECT_GT(points, 1000);
}

}  // namespace
}  // namespace isofield::gpu_test
