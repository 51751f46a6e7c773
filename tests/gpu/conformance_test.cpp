// Compares every composition operator by itself on the device and in double precision: the kernels mirror the canonical
// definition in server/operators, which reference/ uses.
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>

#include "gpu/device_field.h"
#include "gpu/operator_cases.h"
#include "operators/gradient_blend.h"
#include "support/finite_difference.h"
#include "support/paper_scene.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/shared_files.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using operators::Law;
using operators::Operator;
using reference::FieldState;

TEST(Conformance, EveryOperatorIsTheSameOnTheDevice) {
  for (const Case& c : cases()) {
    if (c.op.has_angular_ranges()) continue;
    SCOPED_TRACE(c.name);
    const bool is_signed = c.op.law() == Law::kSigned;
    test_support::Random random(17);
    std::vector<float> rows;
    constexpr int kRows = 4000;
    for (int i = 0; i < kRows; ++i) {
      for (std::size_t k = 0; k < c.operands; ++k) {
        const double x = is_signed ? random.number(-2, 2) : random.number(0, i % 5 == 0 ? 2 : 1);
        rows.push_back(static_cast<float>(i % 50 == 0 && k == 0 ? 0 : x));
      }
    }
    const std::vector<float> results = on_device(c, rows);
    double worst = 0, worst_partial = 0;
    int smooth = 0;
    for (int i = 0; i < kRows; ++i) {
      const std::vector<double> x(rows.begin() + static_cast<std::ptrdiff_t>(i * c.operands),
                                  rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * c.operands));
      const float* r = &results[i * (1 + c.operands)];
      const FieldState e = exact(c.op, x);
      const double scale = std::max(1.0, std::abs(e.field.v));
      test_support::keep_worst(worst, std::abs(r[0] - e.field.v) / scale);
      if (!is_smooth(c.op, x, e)) continue;
      ++smooth;
      const double partials[] = {e.field.d.x, e.field.d.y, e.field.d.z};
      for (std::size_t k = 0; k < c.operands; ++k) {
        test_support::keep_worst(worst_partial, std::abs(r[1 + k] - partials[k]) / std::max(1.0, length(e.field.d)));
      }
    }
    std::cout << c.name << ": values off by " << worst << ", partials by " << worst_partial << " at " << smooth
              << " smooth points\n";
    EXPECT_LE(worst, c.tolerance);
    EXPECT_LE(worst_partial, 2e-3);
    EXPECT_GE(smooth, kRows / 2);
  }
}

// A power multiplies the relative error of its logarithm by the exponent, and that of its base. A driver's log2 may be
// off by 2^-21, with which values were off by 3e-5.
TEST(Conformance, PowersKeepTheirDigitsAtTheGreatestExponents) {
  std::vector<Case> all;
  for (const double t : {1.0001, 7.3, 31.0, 64.0}) {
    all.push_back({"ricci " + std::to_string(t), operators::Ricci{t}});
    // These ranges are exact in float32.
    all.push_back(
        {"superelliptic " + std::to_string(t), operators::Superelliptic{t, {{0.75, 2, 1}, {1.25, 2, 1}}, {}}});
    all.push_back({"btk " + std::to_string(t), operators::Btk{{{1, t, 1}, {0.7, t, 0.4}, {1.3, 2, 2}}, {}}, 3});
  }
  for (const Case& c : all) {
    SCOPED_TRACE(c.name);
    const bool is_signed = c.op.law() == Law::kSigned;
    test_support::Random random(19);
    std::vector<float> rows;
    constexpr int kRows = 10'000;
    for (std::size_t i = 0; i < kRows * c.operands; ++i) {
      rows.push_back(static_cast<float>(is_signed ? random.number(-1.5, 1) : random.number(0, 1)));
    }
    const std::vector<float> results = on_device(c, rows);
    double worst = 0, worst_partial = 0;
    for (int i = 0; i < kRows; ++i) {
      const auto at = rows.begin() + static_cast<std::ptrdiff_t>(i * c.operands);
      const FieldState e = exact(c.op, {at, at + static_cast<std::ptrdiff_t>(c.operands)});
      const float* r = &results[i * (1 + c.operands)];
      test_support::keep_worst(worst, std::abs(r[0] - e.field.v) / std::max(1.0, std::abs(e.field.v)));
      const double partials[] = {e.field.d.x, e.field.d.y, e.field.d.z};
      for (std::size_t k = 0; k < c.operands; ++k) {
        test_support::keep_worst(worst_partial, std::abs(r[1 + k] - partials[k]) / std::max(1.0, length(e.field.d)));
      }
    }
    std::cout << c.name << ": values off by " << worst << ", partials by " << worst_partial << "\n";
    EXPECT_LE(worst, 1e-6);
    EXPECT_LE(worst_partial, 5e-6);  // the bracket of a btk is 1 + (m h - x) / r, rounded
  }
}

// The operators follow an angle: the gradients of the two fields have the angle and the ratio of lengths of the row.
TEST(Conformance, OperatorsThatFollowAnAngleAreTheSameOnTheDevice) {
  for (const Case& c : cases()) {
    if (!c.op.has_angular_ranges()) continue;
    SCOPED_TRACE(c.name);
    test_support::Random random(23);
    std::vector<float> rows;
    constexpr int kRows = 4000;
    for (int i = 0; i < kRows; ++i) {
      const double alpha = i % 40 == 0 ? 0 : i % 41 == 0 ? std::numbers::pi : random.number(0, std::numbers::pi);
      for (const double x : {random.number(-2, 2), random.number(-2, 2), alpha, random.number(0.3, 3)}) {
        rows.push_back(static_cast<float>(x));
      }
    }
    const std::vector<float> results = on_device(c, rows);
    double worst = 0;
    for (int i = 0; i < kRows; ++i) {
      const float* a = &rows[4 * i];
      const FieldState e = exact_at(c.op, a[0], a[1], a[2], a[3]);
      test_support::keep_worst(worst, std::abs(results[4 * i] - e.field.v) / std::max(1.0, std::abs(e.field.v)));
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::isfinite(results[4 * i + k])) << "row " << i;
    }
    std::cout << c.name << ": values off by " << worst << "\n";
    EXPECT_LE(worst, c.tolerance);
  }
}

TEST(Conformance, PartialsByTheAngleAreDifferencesOfValues) {
  for (const Case& c : cases()) {
    if (!c.op.has_angular_ranges()) continue;
    SCOPED_TRACE(c.name);
    test_support::Random random(29);
    std::vector<float> rows;
    constexpr int kRows = 1000;
    constexpr float kStep = 1.0f / 128;
    for (int i = 0; i < kRows; ++i) {
      const auto x1 = static_cast<float>(random.number(-0.5, 1)), x2 = static_cast<float>(random.number(-0.5, 1));
      const auto alpha = static_cast<float>(random.number(0.2, 2.9));
      for (const float moved : {alpha - kStep, alpha, alpha + kStep}) rows.insert(rows.end(), {x1, x2, moved, 1.25f});
    }
    const std::vector<float> r = on_device(c, rows);
    std::vector<double> errors;
    for (int i = 0; i < kRows; ++i) {
      const float* low = &r[12 * i];
      errors.push_back(std::abs((low[8] - low[0]) / (2 * kStep) - low[4 + 3]) / std::max(1.0f, std::abs(low[4 + 3])));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors[kRows * 95 / 100], 1e-2);  // the cosine bends at a right angle, and the blend ends at its edge
  }
}

// Compares exact partials with central differences of exact values, and the device's partials with the same
// differences. Places where differences with two steps or to both sides do not agree are left out and counted. The
// device's partials are not compared where is_smooth() says that float32 cannot follow.
class PartialsByDifferences {
 public:
  // value(k, x) is the operator's value with argument k replaced by x.
  template <class Value>
  void compare(const std::vector<double>& arguments, const std::vector<double>& partials, const float* device,
               const Value& value) {
    for (std::size_t k = 0; k < partials.size(); ++k) {
      const double x = arguments[k], h = 1e-4;
      const auto slope = test_support::settled_slope([&](double x) { return value(k, x); }, x, h, 1e-6);
      ++all_;
      if (!slope || std::abs(value(k, x + h) - 2 * value(k, x) + value(k, x - h)) > 0.1 * h) continue;
      ++settled_;
      const double scale = std::max(1.0, std::abs(*slope));
      test_support::keep_worst(exact_, std::abs(partials[k] - *slope) / scale);
      if (device != nullptr) test_support::keep_worst(device_, std::abs(device[k] - *slope) / scale);
    }
  }
  void report(const std::string& what) const {
    std::cout << what << ": partials off their differences by " << exact_ << " in double precision, by " << device_
              << " on the device; " << all_ - settled_ << " of " << all_ << " left out\n";
  }
  double exact() const { return exact_; }
  double device() const { return device_; }
  double left_out() const { return 1 - settled_ / static_cast<double>(all_); }

 private:
  double exact_ = 0, device_ = 0;
  int all_ = 0, settled_ = 0;
};

TEST(Conformance, PartialsAreDifferencesOfExactValues) {
  double worst = 0, worst_device = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const bool is_signed = c.op.law() == Law::kSigned;
    test_support::Random random(31);
    std::vector<float> rows;
    constexpr int kRows = 500;
    const std::size_t columns = c.operands + (c.op.has_angular_ranges() ? 2 : 0),
                      partials = c.operands + (c.op.has_angular_ranges() ? 1 : 0);
    for (int i = 0; i < kRows; ++i) {
      for (std::size_t k = 0; k < c.operands; ++k) {
        rows.push_back(static_cast<float>(is_signed ? random.number(-1.5, 1.5) : random.number(0.01, 1.5)));
      }
      if (!c.op.has_angular_ranges()) continue;
      rows.push_back(static_cast<float>(random.number(0.01, std::numbers::pi - 0.01)));
      rows.push_back(static_cast<float>(random.number(0.3, 3)));
    }
    const std::vector<float> device = on_device(c, rows);
    PartialsByDifferences differences;
    for (int i = 0; i < kRows; ++i) {
      const auto at = rows.begin() + static_cast<std::ptrdiff_t>(i * columns);
      const std::vector<double> x(at, at + static_cast<std::ptrdiff_t>(columns));
      const auto state = [&](const std::vector<double>& x) {
        return c.op.has_angular_ranges() ? exact_at(c.op, x[0], x[1], x[2], x[3]) : exact(c.op, x);
      };
      const FieldState e = state(x);
      const double d[] = {e.field.d.x, e.field.d.y, e.field.d.z};
      // Ranges of a hundredth, which aligned surfaces have, are within the step of a difference.
      const bool is_even = c.op.has_angular_ranges() || is_smooth(c.op, x, e);
      differences.compare(x, {d, d + partials}, is_even ? &device[i * (1 + partials) + 1] : nullptr,
                          [&](std::size_t k, double moved) {
                            std::vector<double> y = x;
                            y[k] = moved;
                            return state(y).field.v;
                          });
    }
    differences.report(c.name);
    EXPECT_LE(differences.exact(), 1e-4);
    EXPECT_LE(differences.device(), 1e-4);
    EXPECT_LE(differences.left_out(), 0.2);
    test_support::keep_worst(worst, differences.exact());
    test_support::keep_worst(worst_device, differences.device());
  }
  test_support::figure("partials off differences, double precision", worst);
  test_support::figure("partials off differences, device", worst_device);
}

TEST(Conformance, PartialsOfGoldenGradientBlendsAreDifferencesOfExactValues) {
  using operators::Silhouette;
  const std::pair<const char*, Silhouette> files[] = {{"gradient_smooth.csv", {}},
                                                      {"gradient_bulge_0.25.csv", {Silhouette::Kind::kBulge, 0.25}},
                                                      {"gradient_bulge_0.8.csv", {Silhouette::Kind::kBulge, 0.8}}};
  for (const auto& [file, silhouette] : files) {
    const auto table = test_support::read_csv(test_support::checkout_file(std::string("tests/golden/") + file));
    ASSERT_TRUE(table.ok()) << table.status();
    const Operator op = operators::Gradient{.silhouette = silhouette};
    std::vector<float> rows;
    for (const auto& row : table->rows) {
      for (int k = 0; k < 3; ++k) rows.push_back(static_cast<float>(row[k]));
    }
    const std::vector<float> device = on_device({file, op}, rows);
    PartialsByDifferences differences;
    for (std::size_t i = 0; i < table->rows.size(); ++i) {
      const std::vector<double> x(rows.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                  rows.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
      const operators::Blend e = operators::gradient_blend(x[0], x[1], x[2], silhouette);
      differences.compare(x, {e.g1, e.g2, e.gt}, &device[4 * i + 1],
                          [&, &silhouette = silhouette](std::size_t k, double moved) {
                            double y[] = {x[0], x[1], x[2]};
                            y[k] = moved;
                            // The operator ends at fields of 0 and at 0 and 45 degrees.
                            const bool is_within = moved >= 0 && (k < 2 || moved <= std::numbers::pi / 4);
                            return is_within ? operators::gradient_blend(y[0], y[1], y[2], silhouette).g : std::nan("");
                          });
    }
    differences.report(file);
    EXPECT_LE(differences.exact(), 1e-4);
    EXPECT_LE(differences.device(), 1e-4);
    EXPECT_LE(differences.left_out(), 0.2);
  }
}

// The rows lie at the control points, where one piece of the curve ends and the next begins, before the first and
// beyond the last.
TEST(Conformance, FunctionalBlendsAreTheReferencesAtTheirControlPoints) {
  const Operator op = operators::Functional{
      operators::SampledCurve({0.125, 0.25, 0.2500001, 0.5, 1}, {0.5, 0.4, 0.3999999, 0.2, 0.0625})};
  std::vector<float> rows;
  for (const float x : {0.0f, 0.125f, 0.25f, 0.2500001f, 0.5f, 1.0f, 2.0f}) {
    for (const float at : {std::nextafter(x, -1.0f), x, std::nextafter(x, 3.0f)}) {
      rows.insert(rows.end(), {0, at, at, 0, 0, -at});
    }
  }
  const std::vector<float> results = on_device({"functional", op}, rows);
  for (std::size_t i = 0; 2 * i < rows.size(); ++i) {
    const float x1 = rows[2 * i], x2 = rows[2 * i + 1];
    const FieldState e = exact(op, {x1, x2});
    EXPECT_NEAR(results[3 * i], e.field.v, 3e-7) << x1 << ", " << x2;
    if (std::abs(std::abs(x1 - x2) - 0.25f) < 1e-6f) continue;  // the slope turns within an ulp
    if (x1 != x2 && std::abs(x1 - x2) < 1e-37f)
      continue;  // a driver may take denormals for 0, where the partials of either side are right
    EXPECT_NEAR(results[3 * i + 1], e.field.d.x, 1e-5) << x1 << ", " << x2;
    EXPECT_NEAR(results[3 * i + 2], e.field.d.y, 1e-5) << x1 << ", " << x2;
  }
}

// Returns every operator of positive fields that has a form, as an intersection.
std::vector<Case> positive_intersections() {
  std::vector<Case> all;
  for (const Case& c : cases()) {
    if (c.op.law() == Law::kPositive && c.op.form == operators::Form::kIntersection) all.push_back(c);
  }
  using operators::Gradient, operators::Silhouette;
  const auto add = [&](const char* name, Operator op, double tolerance = 3e-6) {
    op.form = operators::Form::kIntersection;
    all.push_back({name, std::move(op), 2, tolerance});
  };
  add("gradient", Gradient{});
  add("gradient of a volume", Gradient{.volume = 32}, 2e-2);
  add("bulge", Gradient{.silhouette = {Silhouette::Kind::kBulge, 0.6}});
  add("sampled silhouette",
      Gradient{.silhouette = {Silhouette::Kind::kSampled, 0,
                              operators::SampledCurve::even(0, std::numbers::pi / 2, {1, 1.05, 1.2, 1.02, 1})}},
      1e-4);
  auto samples = std::make_shared<operators::SampledVolume>();
  samples->size = 5;
  for (int i = 0; i < 125; ++i) samples->values.push_back(std::hypot(i % 5 / 4.0f, i / 5 % 5 / 4.0f));
  add("sampled", operators::Sampled{.samples = samples});
  return all;
}

// If a complement is not positive, the union of complements is their greatest one.
TEST(Conformance, IntersectionsOfPositiveFieldsAboveOneAreTheLeast) {
  const float fields[] = {0.3f, 0.7f, 1, 1.27f, 1.5f, 4, 1e6f};
  for (Case c : positive_intersections()) {
    SCOPED_TRACE(c.name);
    std::vector<float> rows;
    for (const float f1 : fields) {
      for (const float f2 : fields) {
        rows.insert(rows.end(), {f1, f2});
        if (c.op.is_steered()) rows.push_back(0.3f);
      }
    }
    const std::size_t columns = c.op.is_steered() ? 3 : 2;
    const std::vector<float> intersections = on_device(c, rows);
    c.op.form = operators::Form::kDifference;
    const std::vector<float> differences = on_device(c, rows);
    for (std::size_t row = 0; row * columns < rows.size(); ++row) {
      const float f1 = rows[row * columns], f2 = rows[row * columns + 1];
      SCOPED_TRACE(testing::Message() << f1 << ", " << f2);
      const float *i = &intersections[row * (columns + 1)], *d = &differences[row * (columns + 1)];
      if (f1 >= 1 && f2 >= 1) {
        EXPECT_EQ(i[0], std::min(f1, f2));
        EXPECT_EQ(i[1], f1 <= f2 ? 1 : 0);
        EXPECT_EQ(i[2], f1 <= f2 ? 0 : 1);
      } else if (f1 >= 1 || f2 >= 1) {
        EXPECT_NEAR(i[0], std::min(f1, f2), 1e-7);
        EXPECT_EQ(i[1], f1 <= f2 ? 1 : 0);
        EXPECT_EQ(i[2], f1 <= f2 ? 0 : 1);
      }
      // The first field less the second is the intersection with 1 - f2, which is never above 1.
      if (f2 >= 1) {
        EXPECT_EQ(d[0], 0);
        EXPECT_EQ(d[1], 0);
        EXPECT_EQ(d[2], 0);
      } else if (f1 >= 1) {
        EXPECT_NEAR(d[0], 1 - f2, 1e-7);
        EXPECT_EQ(d[1], 0);
        EXPECT_EQ(d[2], -1);
      }
      if (c.op.is_steered()) {
        if (f1 >= 1 || f2 >= 1) {
          EXPECT_EQ(i[3], 0);
          EXPECT_EQ(d[3], 0);
        }
        continue;
      }
      EXPECT_NEAR(d[0], exact(c.op, {f1, f2}).field.v, c.tolerance);
    }
  }
}

// The scene folds three sums, which are above 1 where the spheres overlap.
TEST(Conformance, FoldedIntersectionsOfSumsAreTheReferences) {
  std::string nodes;
  std::vector<std::string> sums;
  for (int i = 0; i < 3; ++i) {
    const auto ball = [&](double x) {
      return absl::StrCat(R"({"sphere": {"center": [)", x, ", ", 0.1 * i, R"(, 0], "radius": 0.5, "range": 0.6}},)");
    };
    absl::StrAppend(&nodes, ball(0.15 * i), ball(0.1 + 0.15 * i), R"({"name": "sum)", i,
                    R"(", "sum": {"children": ["#)", 3 * i, R"(", "#)", 3 * i + 1, R"("]}},)");
    sums.push_back(absl::StrCat("sum", i));
  }
  std::vector<blobtree::dvec3> points;
  test_support::Random random(8);
  for (int i = 0; i < 800; ++i) points.push_back(rounded_to_float(random.point(-0.5, 0.8)));
  std::vector<reference::Evaluator> exact_sums;
  for (const std::string& sum : sums) {
    v1::Scene scene = test_support::scene_of_nodes("[" + nodes + R"({"max": {"children": ["sum0"]}}])");
    scene.set_root(sum);
    exact_sums.emplace_back(test_support::read_or_die(scene));
  }
  for (const char* kind : {"clean", "gradient"}) {
    for (const char* form : {"INTERSECTION", "DIFFERENCE"}) {
      SCOPED_TRACE(testing::Message() << kind << " " << form);
      const v1::Scene scene =
          test_support::scene_of_nodes(absl::StrCat("[", nodes, "{\"", kind, R"(": {"children": [")",
                                                    absl::StrJoin(sums, "\", \""), R"("], "form": ")", form, "\"}}]"));
      const reference::Evaluator exact(test_support::read_or_die(scene));
      const std::vector<reference::Sample> device = DeviceField(scene).samples(points);
      int above = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const reference::Sample s = exact.evaluate(points[i]);
        EXPECT_NEAR(device[i].value, s.value, 2e-5);
        std::vector<reference::Sample> fields;
        for (const reference::Evaluator& sum : exact_sums) fields.push_back(sum.evaluate(points[i]));
        const auto least = std::min_element(fields.begin(), fields.end(),
                                            [](const auto& a, const auto& b) { return a.value < b.value; });
        if (least->value < 1.001) continue;
        ++above;
        if (std::string(form) == "DIFFERENCE") {
          EXPECT_EQ(device[i].value, 0);
          continue;
        }
        EXPECT_NEAR(device[i].value, least->value, 1e-6);
        EXPECT_LE(length(device[i].gradient - least->gradient), 1e-5);
      }
      EXPECT_GT(above, 40);
    }
  }
}

void expect_golden(const std::string& file, std::size_t operands,
                   const std::function<Operator(const std::vector<double>&)>& make) {
  const auto table = test_support::read_csv(test_support::checkout_file("tests/golden/" + file));
  ASSERT_TRUE(table.ok()) << table.status();
  ASSERT_GE(table->rows.size(), 400u);
  double worst = 0;
  // The device evaluates all rows with the same parameters together.
  std::map<std::vector<double>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < table->rows.size(); ++i) {
    const std::vector<double>& row = table->rows[i];
    groups[{row.begin() + static_cast<std::ptrdiff_t>(operands), row.end() - 1}].push_back(i);
  }
  for (const auto& [parameters, places] : groups) {
    std::vector<float> rows;
    for (const std::size_t i : places) {
      for (std::size_t k = 0; k < operands; ++k) rows.push_back(static_cast<float>(table->rows[i][k]));
    }
    const std::vector<float> results = on_device({file, make(parameters), operands}, rows);
    for (std::size_t n = 0; n < places.size(); ++n) {
      test_support::keep_worst(worst, std::abs(results[n * (1 + operands)] - table->rows[places[n]].back()));
    }
  }
  std::cout << file << ": max error " << worst << " of " << table->rows.size() << " rows\n";
  EXPECT_LE(worst, 1e-5);
}

// The conics go from nearly the straight cut to nearly the union.
TEST(Conformance, ConicsOfAnyTightnessAreTheSameOnTheDevice) {
  test_support::Random random(19);
  for (const double below : {1e-9, 1e-4, 1.0, 11.0, 1e3, 1e5, 1e8, 1e11, 1e14}) {  // 1 - p / (r1 r2)
    const Operator op = operators::Bt2{{operators::Term{1, 2, 1}, operators::Term{1.5, 2, 1}}, 1.5 * (1 - below), {}};
    std::vector<float> rows;
    for (int i = 0; i < 3000; ++i) {
      const double x1 = random.number(-1.5, 1.5), x2 = random.number(-1.5, 1.5);
      // A third of the rows lie close to where the fields are equal, because tight conics turn there.
      const double near = x1 + std::pow(10, random.number(-7, 0)) * (random.chance(0.5) ? 1 : -1);
      rows.insert(rows.end(), {static_cast<float>(x1), static_cast<float>(i % 3 == 0 ? near : x2)});
    }
    const std::vector<float> results = on_device({"bt2", op}, rows);
    double worst = 0, worst_partial = 0, from_union = 0;
    for (std::size_t i = 0; 2 * i < rows.size(); ++i) {
      const FieldState e = exact(op, {rows[2 * i], rows[2 * i + 1]});
      test_support::keep_worst(worst, std::abs(results[3 * i] - e.field.v));
      worst_partial = std::max(
          {worst_partial, std::abs(results[3 * i + 1] - e.field.d.x), std::abs(results[3 * i + 2] - e.field.d.y)});
      from_union = std::max(from_union, std::min(rows[2 * i], rows[2 * i + 1]) - e.field.v);
    }
    test_support::figure(absl::StrCat("1 - p / (r1 r2) = ", below, ": values off by"), worst);
    test_support::figure("partials off by", worst_partial);
    test_support::figure("from the union at most", from_union);
    EXPECT_LE(worst, 1e-6);
    EXPECT_LE(worst_partial, 1e-5);
  }
}

TEST(Conformance, ReproducesGoldenBt2) {
  expect_golden("hsu_bt2.csv", 2, [](const std::vector<double>& p) {  // r1, r2, p, m1, m2
    return operators::Bt2{{operators::Term{p[0], 2, p[3]}, operators::Term{p[1], 2, p[4]}}, p[2], {}};
  });
}

TEST(Conformance, ReproducesGoldenBtk) {
  expect_golden("hsu_btk.csv", 3, [](const std::vector<double>&) {
    return operators::Btk{{{1, 2, 1}, {0.7, 3, 0.5}, {1.3, 2.5, 2}}, {}};  // the file was made with these parameters
  });
}

}  // namespace
}  // namespace isofield::gpu_test
