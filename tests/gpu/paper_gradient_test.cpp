// The returned gradient is the derivative of the returned field: [G] eq. 29 whole, with the gradient of the opening
// angle. Measured at vertices of meshes, three ways:
//   device gradient      against the gradient of the double-precision reference,
//   reference gradient   against central differences of the reference's value,
//   device gradient      against central differences of the device's value.
//
// Points without a derivative, or too close to one for what is compared, are left out by these rules, and counted:
//   crease     moving by 2e-6 turns the reference's gradient by more than 0.03 degrees: float32 coordinates cannot tell
//              the side. (Beside folds these are the seams between the cap and the side of a segment: its gradient
//              bends there, so the opening angle has a kink and the blend's gradient a jump.)
//   unsettled  for differences of the reference: those with steps of 1e-4 and a third of it differ by 0.01 degrees.
//   stencil    for differences of the device: the same differences in double are off by 0.05 degrees, so that a crease
//              or a tight bend lies within the stencil.
//
// Every other operator is measured at random points, by length instead of angle.
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <set>
#include <tuple>

#include "gpu/device_field.h"
#include "gpu/operator_cases.h"
#include "support/finite_difference.h"
#include "support/paper_scene.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using test_support::Join;
using test_support::soft_segment;
using test_support::soft_sphere;

constexpr double kDegree = std::numbers::pi / 180;

dvec3 axis(int i) {
  return {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
}

double degrees_between(const dvec3& a, const dvec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) / kDegree;
}

// Angles in degrees of the points that are compared, and the number of points that are left out.
struct Angles {
  std::vector<double> of;
  int left_out = 0;

  void add(const dvec3& a, const dvec3& b) { of.push_back(degrees_between(a, b)); }
  double largest() const { return of.empty() ? 180 : *std::max_element(of.begin(), of.end()); }
  // Returns the angle below which `share` of the points are.
  double quantile(double share) {
    if (of.empty()) return 180;
    std::sort(of.begin(), of.end());
    const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(of.size())));
    return of[std::max<std::size_t>(at, 1) - 1];
  }
  double left_out_share() const { return left_out / (left_out + static_cast<double>(of.size())); }
};

struct Comparison {
  Angles device_to_reference, reference_to_differences, device_to_differences;
};

Comparison compare(const v1::Scene& message, double cell, std::size_t most_points) {
  const DeviceField on_device(message);
  const reference::Evaluator exact(test_support::read_or_die(message));
  const engine::Mesh mesh = on_device.mesh(cell);
  std::vector<dvec3> points;
  const std::size_t vertices = mesh.positions.size() / 3, step = vertices / most_points + 1;
  for (std::size_t v = 0; v < vertices; v += step) {
    points.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
  }
  EXPECT_GT(points.size(), most_points / 2);
  const std::vector<reference::Sample> device = on_device.samples(points);

  // The step is 1.4 % of the range of a raw soft object of radius 1: float32 values give slopes to about 1e-4. It is a
  // power of two, so that coordinates move by nearly the stated step.
  constexpr double kStep = 1.0 / 128;
  constexpr std::array<double, 4> kPlaces{-2, -1, 1, 2};
  std::vector<dvec3> stencil;
  for (const dvec3& p : points) {
    for (int a = 0; a < 3; ++a) {
      for (const double place : kPlaces) stencil.push_back(rounded_to_float(p + axis(a) * (place * kStep)));
    }
  }
  const std::vector<double> stencil_values = on_device.values(stencil);

  Comparison all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec3& p = points[i];
    const reference::Sample s = exact.evaluate(p);
    const bool crease = test_support::direction_variation(exact, p, 2e-6) > 0.03 * kDegree;
    if (crease) {
      ++all.device_to_reference.left_out;
    } else {
      all.device_to_reference.add(device[i].gradient, s.gradient);
    }

    const auto differences = [&](double h) {
      std::array<double, 3> d{};
      for (int a = 0; a < 3; ++a) {
        d[a] = test_support::slope([&](double x) { return exact.value(p + axis(a) * x); }, 0, h);
      }
      return dvec3{d[0], d[1], d[2]};
    };
    // This check is slow and concerns the reference only, so it runs at some of the points.
    if (i % 3 == 0) {
      const dvec3 coarse = differences(1e-4), fine = differences(1e-4 / 3);
      if (degrees_between(coarse, fine) > 0.01) {
        ++all.reference_to_differences.left_out;
      } else {
        all.reference_to_differences.add(s.gradient, fine);
      }
    }
    std::array<double, 3> device_stencil{};
    for (int a = 0; a < 3; ++a) {
      const double* v = &stencil_values[12 * i + 4 * a];
      device_stencil[a] = (8 * (v[2] - v[1]) - (v[3] - v[0])) / (12 * kStep);
    }
    if (crease || degrees_between(differences(kStep), s.gradient) > 0.05) {
      ++all.device_to_differences.left_out;
    } else {
      all.device_to_differences.add(device[i].gradient, {device_stencil[0], device_stencil[1], device_stencil[2]});
    }
  }
  return all;
}

// Checks that `share` of the points are within `degrees`.
void expect_within(Comparison c, const std::string& name, double share, double degrees, double most_left_out) {
  const std::pair<const char*, Angles*> pairs[] = {{"device to reference", &c.device_to_reference},
                                                   {"reference to its differences", &c.reference_to_differences},
                                                   {"device to its differences", &c.device_to_differences}};
  for (const auto& [pair, angles] : pairs) {
    const std::string what = name + ", " + pair;
    test_support::figure(what + " at " + std::to_string(100 * share).substr(0, 4) + " %", angles->quantile(share),
                         "deg");
    test_support::figure(what + " largest", angles->largest(), "deg");
    test_support::figure(what + " points left out", 100 * angles->left_out_share(), "%");
    EXPECT_LE(angles->quantile(share), degrees) << what;
    EXPECT_LE(angles->left_out_share(), most_left_out) << what;
  }
}

std::string cylinders(const dvec3& a1, const dvec3& b1, const dvec3& a2, const dvec3& b2) {
  return soft_segment("first", a1, b1, 1) + "," + soft_segment("second", a2, b2, 1);
}

struct Blend {
  const char* name;
  std::string operands;
  Join join;
};

TEST(PaperGradient, IsTheDerivativeOfTheFieldForOneBlend) {
  const std::string t_joint = cylinders({-2, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 2});
  const std::string cross_of_two = cylinders({-2, 0, 0}, {2, 0, 0}, {0, 0, -2}, {0, 0, 2});
  const std::string joint =
      cylinders({0, 0, 0}, {2, 0, 0}, {0, 0, 0}, dvec3{std::cos(30 * kDegree), 0, std::sin(30 * kDegree)} * 2.0);
  const std::string ball =
      soft_segment("first", {-2, 0, 0}, {2, 0, 0}, 1) + "," + soft_sphere("second", {0.1, 0, 0.6}, 1.3);
  const Blend blends[] = {{"T", t_joint, Join::kCamel},
                          {"T", t_joint, Join::kOrganic},
                          {"T", t_joint, Join::kContact},
                          {"cross", cross_of_two, Join::kCamel},
                          {"cross", cross_of_two, Join::kContact},
                          {"30 degree joint", joint, Join::kCamel},
                          {"30 degree joint", joint, Join::kOrganic},
                          {"30 degree joint", joint, Join::kContact},
                          {"sphere on cylinder", ball, Join::kCamel},
                          {"sphere on cylinder", ball, Join::kOrganic}};
  for (const Blend& b : blends) {
    const std::string name = std::string(b.name) + " " + text(b.join);
    expect_within(compare(test_support::scene_of_nodes("[" + b.operands + "," +
                                                       test_support::join_node(b.join, {"first", "second"}) + "]"),
                          0.07, 2000),
                  name, 0.999, 0.5,
                  // Both cylinders end in the same cap: f1 = f2 = 0.5 all over it, where camel is a clean union, whose
                  // slope jumps at the surface. The gradient's direction does not jump.
                  b.operands == joint && b.join == Join::kCamel ? 0.12 : 0.04);
  }
}

TEST(PaperGradient, IsTheDerivativeOfTheFieldForFourNestedBlends) {
  for (const Join join : {Join::kCamel, Join::kOrganic, Join::kContact}) {
    // The scene is a body with four limbs, each blended with all before it.
    const std::string nodes =
        absl::StrJoin(std::vector<std::string>{soft_segment("body", {-1, 0, 0}, {1, 0, 0}, 1.2),
                                               soft_segment("limb1", {0.9, 0, 0}, {1.8, 1.2, 0.3}, 0.8),
                                               soft_segment("limb2", {0.8, 0.1, 0}, {1.6, -1.3, 0.2}, 0.8),
                                               soft_segment("limb3", {-0.9, 0, 0}, {-1.5, 0.9, -1}, 0.8),
                                               soft_segment("limb4", {0.2, 0, 0}, {0.9, 0.5, 1.4}, 0.8),
                                               test_support::join_node(join, {"body", "limb1"}, "one"),
                                               test_support::join_node(join, {"one", "limb2"}, "two"),
                                               test_support::join_node(join, {"two", "limb3"}, "three"),
                                               test_support::join_node(join, {"three", "limb4"}, "four")},
                      ",");
    expect_within(compare(test_support::scene_of_nodes("[" + nodes + "]"), 0.07, 2000),
                  std::string("four nested ") + text(join), 0.99, 2, 0.06);
  }
}

// The largest differences of gradients, relative to max(|gradient|, 0.05).
struct GradientErrors {
  double to_differences = 0;  // the reference's gradient from central differences of its value
  double device = 0;          // the device's gradient from the reference's
  int points = 0, unsettled = 0, creases = 0;

  void include(const GradientErrors& e) {
    to_differences = std::max(to_differences, e.to_differences);
    device = std::max(device, e.device);
    points += e.points;
    unsettled += e.unsettled;
    creases += e.creases;
  }
};

// Compares gradients at random points where the field is not constant, nor so steep that float32 cannot square its
// slope: super-elliptic blends of super-elliptic blends grow beyond 1e75 inside.
GradientErrors gradient_errors(const std::string& nodes) {
  const v1::Scene message = test_support::scene_of_nodes("[" + nodes + "]");
  const reference::Evaluator exact(test_support::read_or_die(message));
  test_support::Random random(5);
  std::vector<dvec3> points;
  for (int tries = 0; tries < 40'000 && points.size() < 80; ++tries) {
    const dvec3 p = rounded_to_float(random.point(-1.1, 1.1));
    const double slope = length(exact.evaluate(p).gradient);
    if (slope > 0.01 && slope < 1e18) points.push_back(p);
  }
  EXPECT_GE(points.size(), 80u) << nodes;
  const std::vector<reference::Sample> device = DeviceField(message).samples(points);
  GradientErrors e;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec3& p = points[i];
    const dvec3 gradient = exact.evaluate(p).gradient;
    const double scale = std::max(length(gradient), 0.05);
    ++e.points;
    std::array<double, 3> d{};
    bool is_settled = true;
    for (int a = 0; a < 3 && is_settled; ++a) {
      const auto slope =
          test_support::settled_slope([&](double x) { return exact.value(p + axis(a) * x); }, 0, 1e-4, 1e-6 * scale);
      is_settled = slope.has_value();
      d[a] = slope.value_or(0);
    }
    if (is_settled) {
      e.to_differences = std::max(e.to_differences, length(dvec3{d[0], d[1], d[2]} - gradient) / scale);
    } else {
      ++e.unsettled;
    }
    if (test_support::gradient_variation(exact, p, 2e-6) > 5e-4 * scale) {
      ++e.creases;
    } else {
      e.device = std::max(e.device, length(device[i].gradient - gradient) / scale);
    }
  }
  return e;
}

void expect_gradients(const std::string& name, const GradientErrors& e, double most_unsettled) {
  std::cout << "  " << name << ": off differences by " << e.to_differences << ", device off by " << e.device << ", of "
            << e.points << " points " << e.unsettled << " unsettled, " << e.creases << " creases\n";
  EXPECT_LE(e.to_differences, 1e-4) << name;
  EXPECT_LE(e.device, 1e-3) << name;
  EXPECT_LE(e.unsettled, most_unsettled * e.points) << name;
  EXPECT_LE(e.creases, most_unsettled * e.points) << name;
}

// Returns five primitives of either law that overlap around the origin.
std::string overlapping(operators::Law law) {
  const char* last = law == operators::Law::kSigned ? R"("law": "SIGNED")" : R"("range": 0.9)";
  std::string all;
  for (const char* primitive :
       {R"("a", "sphere": {"center": [-0.2, 0.1, 0], "radius": 0.6)",
        R"("b", "segment": {"a": [0.1, -0.5, 0.2], "b": [0.7, 0.6, 0.1], "radius_a": 0.4, "radius_b": 0.3)",
        R"("c", "sphere": {"center": [0.1, 0.3, 0.4], "radius": 0.5)",
        R"("d", "torus": {"center": [0.1, 0, 0], "axis": [0.3, 0.2, 1], "major_radius": 0.5, "minor_radius": 0.35)",
        R"("e", "sphere": {"center": [0.2, -0.3, -0.3], "radius": 0.55)"}) {
    all += std::string(R"({"name": )") + primitive + ", " + last + "}},";
  }
  return all;
}

TEST(PaperGradient, IsTheDerivativeOfTheFieldForEveryOperator) {
  GradientErrors all;
  for (const Case& c : cases()) {
    std::vector<std::string> children{"a", "b", "c"};
    children.resize(c.operands);
    const GradientErrors e = gradient_errors(overlapping(c.op.law()) + operator_node(c.op, children));
    expect_gradients(c.name, e, 0.2);
    all.include(e);
  }
  test_support::figure("gradients off differences by at most", all.to_differences);
  test_support::figure("device's gradients off by at most", all.device);
  test_support::figure("points unsettled", 100.0 * all.unsettled / all.points, "%");
  test_support::figure("points on creases", 100.0 * all.creases / all.points, "%");
}

TEST(PaperGradient, IsTheDerivativeOfTheFieldForEveryOperatorNestedFourDeep) {
  GradientErrors all;
  std::set<std::tuple<operators::Kind, operators::Form, bool>> done;
  for (const Case& c : cases()) {
    // One set of parameters of each kind is enough.
    if (c.operands != 2 || !done.insert({c.op.kind(), c.op.form, c.op.has_angular_ranges()}).second) continue;
    const GradientErrors e =
        gradient_errors(overlapping(c.op.law()) + operator_node(c.op, {"a", "b"}, "one") + "," +
                        operator_node(c.op, {"one", "c"}, "two") + "," + operator_node(c.op, {"two", "d"}, "three") +
                        "," + operator_node(c.op, {"three", "e"}, "four"));
    expect_gradients("four " + c.name, e, 0.3);
    all.include(e);
  }
  test_support::figure("gradients off differences by at most", all.to_differences);
  test_support::figure("device's gradients off by at most", all.device);
  test_support::figure("points unsettled", 100.0 * all.unsettled / all.points, "%");
  test_support::figure("points on creases", 100.0 * all.creases / all.points, "%");
}

// The scene hardens gradient blends, blends them by the angle, softens the result and blends by the angle again.
TEST(PaperGradient, IsTheDerivativeOfTheFieldThroughConversions) {
  for (const Join join : {Join::kCamel, Join::kOrganic, Join::kContact}) {
    for (const char* form : {"UNION", "INTERSECTION", "DIFFERENCE"}) {
      const std::string by_angle = std::string(R"("eliminate_bulge": true, "omega": 0.1, "form": ")") + form + "\"}},";
      const std::string nodes =
          soft_sphere("a", {-0.3, 0.1, 0}, 1.3) + "," + soft_segment("b", {0.1, -0.5, 0.2}, {0.7, 0.6, 0.1}, 1) +
          R"(,{"name": "c", "sphere": {"center": [0.1, 0.3, 0.4], "radius": 0.6, "law": "SIGNED"}},)" +
          soft_sphere("d", {0.4, -0.3, 0.1}, 1.2) +
          R"(,{"name": "e", "sphere": {"center": [0.2, -0.3, -0.3], "radius": 0.65, "law": "SIGNED"}},)" +
          test_support::join_node(join, {"a", "b"}, "ab") + R"(,{"name": "s1", "harden": {"child": "ab"}},)" +
          R"({"name": "s2", "btk": {"children": ["s1", "c"], "ranges": [0.5], "weights": [1, 0.5], )" + by_angle +
          R"({"name": "p2", "soften": {"child": "s2", "range": 0.8}},)" +
          test_support::join_node(join, {"p2", "d"}, "p3") + R"(,{"name": "s3", "harden": {"child": "p3"}},)" +
          R"({"name": "s4", "bt2": {"children": ["s3", "e"], "r1": 0.5, "r2": 0.4, "p": 0.1, )" + by_angle +
          R"({"soften": {"child": "s4", "range": 0.8}})";
      expect_gradients(std::string(text(join)) + " in " + form, gradient_errors(nodes), 0.3);
    }
  }
}

}  // namespace
}  // namespace isofield::gpu_test
