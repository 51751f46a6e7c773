// Tests degenerate input of the operators: zero gradients, identical and coincident operands, fields above 1, of 0, of
// a million and one ulp apart, openings of 0 and 45 degrees, and gradients exactly parallel and opposed. Results must
// be finite everywhere, and the device must agree with the reference.
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <span>

#include "gpu/device_field.h"
#include "gpu/operator_cases.h"
#include "operators/gradient_blend.h"
#include "support/paper_scene.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using test_support::soft_segment;
using test_support::soft_sphere;

std::string blend(const std::string& opening, const std::string& silhouette, const std::string& children) {
  return R"({"gradient": {"children": [)" + children + R"(], "opening": )" + opening + R"(, "silhouette": )" +
         silhouette + "}}";
}

std::string flat(int degrees) {
  const std::string d = std::to_string(degrees);
  return R"({"alpha0": 0, "alpha1": 90, "alpha2": 180, "theta0": )" + d + R"(, "theta1": )" + d + R"(, "theta2": )" +
         d + R"(, "w0": 1, "w1": 1})";
}

struct Pair {
  const char* name;
  std::string nodes;     // define the children
  std::string children;  // children of the blend
};

TEST(PaperDegenerate, IsFiniteAndTheReferences) {
  const std::string ball = soft_sphere("a", {0, 0, 0}, 1);
  const Pair pairs[] = {
      {"the same node twice", ball, R"("a", "a")"},
      {"coincident spheres", ball + "," + soft_sphere("b", {0, 0, 0}, 1), R"("a", "b")"},
      {"concentric spheres", ball + "," + soft_sphere("b", {0, 0, 0}, 0.5), R"("a", "b")"},
      {"opposed spheres", ball + "," + soft_sphere("b", {1, 0, 0}, 1), R"("a", "b")"},
      {"touching spheres", ball + "," + soft_sphere("b", {2 * test_support::kSoftRadius, 0, 0}, 1), R"("a", "b")"},
      {"sums above 1",
       ball + "," + soft_sphere("b", {0.2, 0, 0}, 1) +
           R"(, {"name": "ab", "sum": {"children": ["a", "b", "a"]}}, {"name": "ba", "sum": {"children": ["b", "b"]}})",
       R"("ab", "ba", "a")"},
      {"collinear segments",
       soft_segment("a", {-1, 0, 0}, {0.25, 0, 0}, 1) + "," + soft_segment("b", {-0.25, 0, 0}, {1, 0, 0}, 1),
       R"("a", "b")"},
      {"coincident segments",
       soft_segment("a", {-1, 0, 0}, {1, 0, 0}, 1) + "," + soft_segment("b", {1, 0, 0}, {-1, 0, 0}, 1), R"("a", "b")"},
  };
  const std::pair<const char*, std::string> openings[] = {{"camel", R"({"preset": "CAMEL"})"},
                                                          {"organic", R"({"preset": "ORGANIC"})"},
                                                          {"contact", R"({"preset": "CONTACT"})"},
                                                          {"theta 0", flat(0)},
                                                          {"theta 45", flat(45)}};
  const std::pair<const char*, std::string> silhouettes[] = {
      {"smooth", "{}"}, {"bulge 0.8", R"({"kind": "BULGE", "k": 0.8})"}, {"bulge 1", R"({"kind": "BULGE", "k": 1})"}};

  std::vector<dvec3> points{{0, 0, 0},
                            {1e-30, 0, 0},
                            {1e-8, 1e-9, 0},
                            {0.5, 0, 0},
                            {1, 0, 0},
                            {0.2, 0, 0},
                            {0.5, 1e-7, 0},
                            {0, 0, 1},
                            {0, 0, 2},
                            {1e30, 0, 0},
                            {0, 0.25, 0},
                            {0, 1e-4, -1e-4},
                            {test_support::kSoftRadius, 0, 0}};
  test_support::Random random(3);
  for (int i = 0; i < 60; ++i) points.push_back({random.number(-1.5, 1.5), 0, 0});  // alpha 0, pi
  for (int i = 0; i < 60; ++i) points.push_back({0.5, random.number(-0.8, 0.8), random.number(-0.8, 0.8)});  // f1 = f2
  for (int i = 0; i < 80; ++i) points.push_back(random.point(-1.2, 1.2));
  for (dvec3& p : points) p = rounded_to_float(p);

  double worst_value = 0, worst_vertical = 0, worst_gradient = 0;
  std::size_t compared = 0, creases = 0;
  for (const Pair& pair : pairs) {
    for (const auto& [opening_name, opening] : openings) {
      for (const auto& [silhouette_name, silhouette] : silhouettes) {
        const v1::Scene scene =
            test_support::scene_of_nodes("[" + pair.nodes + "," + blend(opening, silhouette, pair.children) + "]");
        const reference::Evaluator exact(test_support::read_or_die(scene));
        const std::vector<reference::Sample> device = DeviceField(scene).samples(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const dvec3& p = points[i];
          const reference::Sample s = exact.evaluate(p);
          const auto where = [&, &opening_name = opening_name, &silhouette_name = silhouette_name] {
            return std::string(pair.name) + ", " + opening_name + ", " + silhouette_name + " at " +
                   std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
          };
          for (const reference::Sample& r : {s, device[i]}) {
            ASSERT_TRUE(std::isfinite(r.value) && std::isfinite(length(r.gradient))) << where();
          }
          const double error = std::abs(device[i].value - s.value) / std::max(1.0, s.value);
          // The bulge of K = 1 ends in a vertical tangent at f1 = f2, so the result contains the square root of
          // float32's error of f1 - f2.
          const bool vertical = std::string(silhouette_name) == "bulge 1";
          (vertical ? worst_vertical : worst_value) = std::max(vertical ? worst_vertical : worst_value, error);
          EXPECT_LE(error, vertical ? 1e-3 : 4e-6) << where() << ": " << device[i].value << ", exact " << s.value;
          if (vertical) continue;
          // As on random scenes, points are left out where float32 coordinates cannot tell the side of a crease.
          const double scale = std::max(length(s.gradient), 0.05);
          ++compared;
          if (test_support::gradient_variation(exact, p, 2e-6) > 5e-4 * scale) {
            ++creases;
            continue;
          }
          const double turn = length(device[i].gradient - s.gradient) / scale;
          worst_gradient = std::max(worst_gradient, turn);
          EXPECT_LE(turn, 1e-3) << where();
        }
      }
    }
  }
  test_support::figure("largest error of values", worst_value);
  test_support::figure("largest error of values with K = 1", worst_vertical);
  test_support::figure("largest relative error of gradients", worst_gradient);
  test_support::figure("points on creases", 100.0 * static_cast<double>(creases) / static_cast<double>(compared), "%");
}

using operators::Kind;
using operators::Law;
using operators::Operator;

// Returns cases() and more cases at the ends of parameters' ranges.
std::vector<Case> extreme_cases() {
  std::vector<Case> all = cases();
  using namespace operators;
  all.push_back({"barthe 45 degrees", Barthe{std::numbers::pi / 4, std::numbers::pi / 4}});
  all.push_back({"barthe 45 and 0 degrees", Barthe{std::numbers::pi / 4, 0}});
  for (const double weight : {0.0, 1.0}) all.push_back({"bernhardt " + std::to_string(weight), Bernhardt{{}, weight}});
  all.push_back({"pasko narrow", Pasko{2, 1e-3, 1e-3}});
  all.push_back({"bt2 of unlike ranges", Bt2{{Term{1e-3, 2, 1}, Term{1e3, 2, 1}}, -9, {}}});
  all.push_back({"bt2 of unlike weights", Bt2{{Term{1, 2, 1e-3}, Term{1, 2, 1e3}}, 0.999, {}}, 2, 1e-5});
  const auto add_btk = [&](const char* name, std::vector<Term> terms) {
    all.push_back({name, Btk{std::move(terms), {}}, 2, 1e-5});
  };
  add_btk("btk of powers 64", {{1, 64, 1}, {1, 64, 1}});
  add_btk("btk of powers 1.01", {{1, 1.01, 1}, {1, 1.01, 1}});
  add_btk("btk of unlike weights", {{1, 2, 1e-3}, {1, 2, 1e3}});
  add_btk("btk of unlike ranges", {{1e-3, 2, 1}, {1e3, 2, 1}});
  return all;
}

double least_weight(const Operator& op) {
  double least = 1;
  for (const operators::Term& t : terms_of(op)) least = std::min(least, t.weight);
  return least;
}

std::vector<float> degenerate_fields(Law law) {
  std::vector<float> all{0,
                         1e-30f,
                         1e-6f,
                         0.25f,
                         std::nextafter(0.5f, 0.0f),
                         0.5f,
                         std::nextafter(0.5f, 1.0f),
                         1,
                         std::nextafter(1.0f, 2.0f),
                         1.5f,
                         2,
                         1000,
                         1e6f};
  if (law == Law::kSigned) {
    for (std::size_t i = 1, count = all.size(); i < count; ++i) all.push_back(-all[i]);
  }
  return all;
}

// Errors are relative to the largest number in the row, because float32 sums are not better than that.
TEST(PaperDegenerate, EveryOperatorIsFiniteAndTheReferencesAtDegenerateFields) {
  double all_worst = 0;
  std::size_t all_rows = 0;
  for (const Case& c : extreme_cases()) {
    SCOPED_TRACE(c.name);
    std::vector<float> rows;
    const std::vector<float> fields = degenerate_fields(c.op.law());
    for (const float x1 : fields) {
      for (const float x2 : fields) {
        if (c.op.has_angular_ranges()) {
          for (const float alpha : {0.0f, 1e-4f, 1.5707964f, 3.1415925f}) {
            for (const float ratio : {1e-6f, 1.0f, 8.0f, 1e6f}) rows.insert(rows.end(), {x1, x2, alpha, ratio});
          }
        } else if (c.operands == 2) {
          rows.insert(rows.end(), {x1, x2});
        } else {
          for (const float x3 : {0.0f, 0.5f, -1.0f, 1e6f, -1e6f, x1}) rows.insert(rows.end(), {x1, x2, x3});
        }
      }
    }
    const std::size_t columns = c.operands + (c.op.has_angular_ranges() ? 2 : 0),
                      width = 1 + c.operands + (c.op.has_angular_ranges() ? 1 : 0);
    const std::vector<float> results = on_device(c, rows);
    double worst = 0;
    for (std::size_t i = 0; i * columns < rows.size(); ++i) {
      const auto at = rows.begin() + static_cast<std::ptrdiff_t>(i * columns);
      const std::vector<double> x(at, at + static_cast<std::ptrdiff_t>(columns));
      const auto row = [&] { return "at " + absl::StrJoin(x, " "); };
      const reference::FieldState e =
          c.op.has_angular_ranges() ? exact_at(c.op, x[0], x[1], x[2], x[3]) : exact(c.op, x);
      ASSERT_TRUE(std::isfinite(e.field.v) && std::isfinite(length(e.field.d))) << row();
      for (const float r : std::span(&results[i * width], width)) ASSERT_TRUE(std::isfinite(r)) << row();
      double scale = std::max(1.0, std::abs(e.field.v));
      for (std::size_t k = 0; k < c.operands; ++k) scale = std::max(scale, std::abs(x[k]) / least_weight(c.op));
      const double error = std::abs(results[i * width] - e.field.v) / scale;
      worst = std::max(worst, error);
      EXPECT_LE(error, c.tolerance) << row() << ": " << results[i * width] << ", exact " << e.field.v;
    }
    std::cout << "  " << c.name << ": values off by " << worst << " at " << rows.size() / columns << " rows\n";
    all_worst = std::max(all_worst, worst);
    all_rows += rows.size() / columns;
  }
  test_support::figure("rows", static_cast<double>(all_rows));
  test_support::figure("values off by at most", all_worst);
}

TEST(PaperDegenerate, GradientBlendsAreFiniteAndTheReferencesAtDegenerateFields) {
  using operators::Silhouette;
  std::vector<float> rows;
  for (const float f1 : degenerate_fields(Law::kPositive)) {
    for (const float f2 : degenerate_fields(Law::kPositive)) {
      for (const float theta : {0.0f, 1e-7f, 0.4f, 0.785398f, 0.7853981f}) rows.insert(rows.end(), {f1, f2, theta});
    }
  }
  using Bulge = Silhouette::Kind;
  for (const Silhouette& silhouette :
       {Silhouette{}, Silhouette{Bulge::kBulge, 0.0}, Silhouette{Bulge::kBulge, 0.8}, Silhouette{Bulge::kBulge, 1}}) {
    const Operator op = operators::Gradient{.silhouette = silhouette};
    const std::vector<float> results = on_device({"gradient", op}, rows);
    double worst = 0;
    for (std::size_t i = 0; 3 * i < rows.size(); ++i) {
      const float* a = &rows[3 * i];
      const operators::Blend e = operators::gradient_blend(a[0], a[1], a[2], silhouette);
      const auto row = [&] { return absl::StrCat("at ", a[0], " ", a[1], " ", a[2]); };
      for (const double r : {e.g, e.g1, e.g2, e.gt}) ASSERT_TRUE(std::isfinite(r)) << row();
      for (const float r : std::span(&results[4 * i], 4)) ASSERT_TRUE(std::isfinite(r)) << row();
      const double error = std::abs(results[4 * i] - e.g) / std::max(1.0, e.g);
      worst = std::max(worst, error);
      EXPECT_LE(error, 3e-6) << row() << ": " << results[4 * i] << ", exact " << e.g;
    }
    const bool is_bulge = silhouette.kind == Bulge::kBulge;
    test_support::figure(
        absl::StrCat(is_bulge ? absl::StrCat("bulge ", silhouette.k) : "smooth", ": values off by at most"), worst);
  }
}

// The scene has a sphere, and a segment of no length, which is a sphere, too.
struct Balls {
  const char* name;
  double x, radius;  // of the second sphere
};

TEST(PaperDegenerate, EveryOperatorIsFiniteAndTheReferencesOnDegenerateShapes) {
  const Balls pairs[] = {{"coincident", 0, 0.5},
                         {"concentric", 0, 0.25},
                         {"opposed", 0.5, 0.5},
                         {"touching", 1, 0.5},
                         {"an ulp apart", 1.1920929e-7, 0.5}};
  std::vector<dvec3> points{{0, 0, 0},   {1e-30, 0, 0}, {1e-8, 1e-9, 0},  {0.25, 0, 0},
                            {0.5, 0, 0}, {1, 0, 0},     {0, 0.5, 0},      {0.25, 0.3, 0},
                            {0, 0, 2},   {1e30, 0, 0},  {0, 1e-4, -1e-4}, {0.5, 0, 0.5}};
  test_support::Random random(3);
  for (int i = 0; i < 20; ++i) points.push_back({random.number(-1.5, 1.5), 0, 0});  // on the line of both
  for (int i = 0; i < 20; ++i) points.push_back(random.point(-1.2, 1.2));
  for (dvec3& p : points) p = rounded_to_float(p);
  double worst_value = 0, worst_gradient = 0;
  std::size_t compared = 0, creases = 0, centres = 0;
  for (const Case& c : extreme_cases()) {
    if (c.operands != 2) continue;
    SCOPED_TRACE(c.name);
    const char* law = c.op.law() == Law::kSigned ? R"("law": "SIGNED"}})" : R"("range": 0.6}})";
    for (const Balls& pair : pairs) {
      const std::string centre = absl::StrFormat("[%.17g, 0, 0]", pair.x);
      const std::string a = absl::StrCat(R"({"name": "a", "sphere": {"radius": 0.5, )", law),
                        b = absl::StrCat(R"({"name": "b", "segment": {"a": )", centre, R"(, "b": )", centre,
                                         R"(, "radius_a": )", pair.radius, R"(, "radius_b": )", pair.radius, ", ", law);
      const v1::Scene scene =
          test_support::scene_of_nodes(absl::StrCat("[", a, ",", b, ",", operator_node(c.op, {"a", "b"}), "]"));
      const reference::Evaluator exact(test_support::read_or_die(scene));
      const std::vector<reference::Sample> device = DeviceField(scene).samples(points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec3& p = points[i];
        const reference::Sample s = exact.evaluate(p);
        const auto where = [&] { return absl::StrCat(pair.name, " at ", p.x, " ", p.y, " ", p.z); };
        for (const reference::Sample* sample : {&s, &device[i]}) {
          const reference::Sample& r = *sample;
          EXPECT_TRUE(std::isfinite(r.value) && std::isfinite(length(r.gradient)))
              << where() << (&r == &s ? ", reference: " : ", device: ") << r.value << " with gradient " << r.gradient.x
              << " " << r.gradient.y << " " << r.gradient.z;
        }
        // A field with a slope changes where float32 rounds the coordinates.
        const double slope = std::max(length(s.gradient), 0.05);
        const double scale =
            std::max({1.0, std::abs(s.value), std::min(length(p), 1e10) / least_weight(c.op), 0.1 * slope});
        const double error = std::abs(device[i].value - s.value) / scale;
        ++compared;
        // Gradients around a centre point everywhere, so an angle has no value there.
        if (c.op.has_angular_ranges() && length(p - dvec3{pair.x, 0, 0}) * length(p) < 1e-6) {
          ++centres;
          continue;
        }
        worst_value = std::max(worst_value, error);
        EXPECT_LE(error, c.tolerance) << where() << ": " << device[i].value << ", exact " << s.value;
        if (test_support::gradient_variation(exact, p, 2e-6) > 5e-4 * slope) {
          ++creases;
          continue;
        }
        // The bound is that of partials in the conformance tests.
        const double turn = length(device[i].gradient - s.gradient) / std::max(slope, 1.0);
        worst_gradient = std::max(worst_gradient, turn);
        EXPECT_LE(turn, 2e-3) << where();
      }
    }
  }
  test_support::figure("points", static_cast<double>(compared));
  test_support::figure("points at centres, of operators that follow an angle", static_cast<double>(centres));
  test_support::figure("values off by at most", worst_value);
  test_support::figure("gradients off by at most", worst_gradient);
  test_support::figure("points on creases", 100.0 * static_cast<double>(creases) / static_cast<double>(compared), "%");
}

// The squares of such fields are 0 in float32. Fields of primitives are at least 1.7e-21 if they are not 0. A device
// that flushes denormals would have specks inside where two primitives end at the same place.
TEST(PaperDegenerate, CleanUnionOfTinyFieldsIsTiny) {
  const Case clean{"clean", of_kind(Kind::kClean)};
  for (const float f : {1e-18f, 1e-19f, 1e-20f, 1e-30f}) EXPECT_LT(on_device(clean, {f, f})[0], 1e-17f) << f;
  const v1::Scene scene = test_support::scene_of_nodes(
      R"([{"name": "a", "sphere": {"center": [-0.5, 0, 0], "radius": 0.25, "range": 0.25}},
          {"name": "b", "sphere": {"center": [0.5, 0, 0], "radius": 0.25, "range": 0.25}},
          {"clean": {"children": ["a", "b"]}}])");
  std::vector<dvec3> points;
  for (int i = -2000; i <= 2000; ++i) points.push_back({0, 0, 1e-7 * i});
  for (const double value : DeviceField(scene).values(points)) EXPECT_LT(value, 0.5);
}

// The arcs of the clean union have no radius where both fields are 0.5 up to rounding.
TEST(PaperDegenerate, CleanUnionOfTwoFieldsOfAHalfIsFinite) {
  for (const double f1 : {0.5, std::nextafter(0.5, 1.0), 0.5 + 4e-16}) {
    for (const double f2 : {0.5, std::nextafter(0.5, 1.0), std::nextafter(0.5, 0.0)}) {
      const reference::FieldState e = exact(of_kind(Kind::kClean), {f1, f2});
      EXPECT_TRUE(std::isfinite(e.field.v) && std::isfinite(length(e.field.d))) << f1 - 0.5 << " " << f2 - 0.5;
    }
  }
}

// The 64th power of the depth would overflow in float32 from a depth of three ranges on.
TEST(PaperDegenerate, ASuperellipticBlendIsFiniteDeepInside) {
  const v1::Scene scene = test_support::scene_of_nodes(
      R"([{"name": "a", "sphere": {"radius": 1, "law": "SIGNED"}},
          {"name": "b", "sphere": {"center": [1, 0, 0], "radius": 1, "law": "SIGNED"}},
          {"superelliptic": {"children": ["a", "b"], "exponent": 64, "ranges": [0.1]}}])");
  std::vector<dvec3> points;
  for (int i = 0; i <= 20; ++i) points.push_back({0.1 * i - 0.5, 0.01, 0.02});
  for (const reference::Sample& s : DeviceField(scene).samples(points)) {
    EXPECT_TRUE(std::isfinite(s.value) && std::isfinite(length(s.gradient)))
        << s.value << " with gradient " << s.gradient.x << " " << s.gradient.y << " " << s.gradient.z;
  }
  // The cells are so large that a corner is as deep as that.
  const engine::Mesh mesh = DeviceField(scene).mesh(0.37);
  EXPECT_FALSE(mesh.positions.empty());
  for (const float x : mesh.positions) EXPECT_TRUE(std::isfinite(x)) << x;
}

}  // namespace
}  // namespace isofield::gpu_test
