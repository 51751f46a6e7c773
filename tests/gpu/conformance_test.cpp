// Every composition operator by itself, on the device and in double precision: the canonical definition of
// server/operators as reference/ uses it against the kernels' mirror of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>

#include "engine/operator_evaluator.h"
#include "gpu/gpu_environment.h"
#include "reference/field_state.h"
#include "support/random_scene.h"
#include "support/shared_files.h"

namespace isofield::gpu_test {
namespace {

using engine::Steering;
using operators::Form;
using operators::Kind;
using operators::Law;
using operators::Operator;
using reference::Dual;
using reference::FieldState;

struct Case {
  std::string name;
  Operator op;
  std::size_t operands = 2;
  // Values may differ by so much times max(1, |exact|), partials by so much more.
  double tolerance = 3e-6;
};

std::vector<float> evaluate(const Case& c, const std::vector<float>& arguments) {
  static engine::OperatorEvaluator evaluator(device(), kernels(), volumes());
  const Steering steering = c.op.by_angle ? Steering::kAlpha : Steering::kNone;
  const std::size_t columns = c.operands + (c.op.by_angle ? 2 : 0);
  std::vector<float> results(arguments.size() / columns * (1 + c.operands + (c.op.by_angle ? 1 : 0)));
  const absl::Status status =
      evaluator.evaluate(std::make_shared<const Operator>(c.op), c.operands, steering, arguments, results);
  EXPECT_TRUE(status.ok()) << status;
  return results;
}

// The operator on fields whose directions are such that the result's direction tells the partials: at most three.
FieldState exact(const Operator& op, const std::vector<double>& x) {
  std::vector<FieldState> operands;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const blobtree::dvec3 unit{i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0};
    operands.push_back({Dual(x[i], unit), {Dual(unit.x), Dual(unit.y), Dual(unit.z)}});
  }
  return combine({&op, operators::law_of(op.kind), 1}, operands);
}

Operator of_kind(Kind kind) {
  Operator op;
  op.kind = kind;
  return op;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Kind kind : {Kind::kSum, Kind::kMax, Kind::kMin, Kind::kDifference}) {
    all.push_back({"classic " + std::to_string(static_cast<int>(kind)), of_kind(kind)});
  }
  Operator op = of_kind(Kind::kRicci);
  for (const double t : {1.0, 2.5, 64.0}) {
    op.exponent = t;
    all.push_back({"ricci " + std::to_string(t), op});
  }
  for (const Form form : {Form::kUnion, Form::kIntersection, Form::kDifference}) {
    const std::string suffix = form == Form::kUnion          ? ""
                               : form == Form::kIntersection ? " intersection"
                                                             : " difference";
    const auto add = [&](std::string name, Operator o, std::size_t operands = 2, double tolerance = 3e-6) {
      o.form = form;
      all.push_back({name + suffix, std::move(o), operands, tolerance});
    };
    // Next to its sharp edge the clean union's arcs shrink to nothing.
    add("clean", of_kind(Kind::kClean), 2, 2e-5);
    op = of_kind(Kind::kBarthe);
    for (const auto& [theta1, theta2] : {std::pair{0.0, 0.0}, {0.2, 0.6}, {0.7, 0.1}, {0.785, 0.785}}) {
      op.theta1 = theta1;
      op.theta2 = theta2;
      add("barthe " + std::to_string(theta1), op);
    }
    op = of_kind(Kind::kBernhardt);
    op.theta1 = op.theta2 = 0.3;
    op.weight = 0.4;
    add("bernhardt", op, 2, 2e-5);
    add("r_union", of_kind(Kind::kRUnion));
    op = of_kind(Kind::kPasko);
    op.a0 = -0.4;
    op.a1 = 0.7;
    op.a2 = 1.2;
    add("pasko", op);
    op = of_kind(Kind::kSuperelliptic);
    op.exponent = 2.5;
    op.terms = {{0.8, 2, 1}, {1.1, 2, 1}};
    add("superelliptic", op);
    op.by_angle = true;
    // Ranges of a hundredth make the field steep.
    add("superelliptic by angle", op, 2, 5e-5);
    op = of_kind(Kind::kBt2);
    for (const double conic : {-2.0, 0.0, 0.9}) {
      for (const double m : {1.0, 0.3}) {
        op.terms = {{1, 2, m}, {1.2, 2, 1}};
        op.conic = conic;
        add("bt2 " + std::to_string(conic), op);
      }
    }
    op.by_angle = true;
    add("bt2 by angle", op, 2, 1e-5);
    op = of_kind(Kind::kBtk);
    op.terms = {{1, 2, 1}, {0.7, 3, 0.4}, {1.3, 1.5, 2}};
    add("btk of 3", op, 3, 1e-5);
    op.terms = {{1, 2, 1}};
    add("btk of 2", op, 2, 1e-5);
    op.terms = {{1, 2, 0.5}, {0.8, 4, 1}};
    op.by_angle = true;
    add("btk by angle", op, 2, 2e-5);
  }
  op = of_kind(Kind::kFunctional);
  op.curve = operators::SampledCurve({-0.5, 0.0, 0.3, 0.9}, {0.8, 0.5, 0.1, 0.0});
  all.push_back({"functional", op});
  return all;
}

// Where partials jump or bend sharply float32 cannot follow: told by moving the arguments.
bool is_smooth(const Operator& op, const std::vector<double>& x, const FieldState& here) {
  // Where a form of positive fields is all but 0 it is clamped.
  if (operators::law_of(op.kind) == Law::kPositive && here.field.v < 1e-6) return false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (const double step : {-1e-5, 1e-5}) {
      std::vector<double> moved = x;
      moved[i] += step;
      if (length(exact(op, moved).field.d - here.field.d) > 5e-4 * std::max(1.0, length(here.field.d))) return false;
    }
  }
  return true;
}

TEST(Conformance, EveryOperatorIsTheSameOnTheDevice) {
  for (const Case& c : cases()) {
    if (c.op.by_angle) continue;
    SCOPED_TRACE(c.name);
    const bool is_signed = operators::law_of(c.op.kind) == Law::kSigned;
    test_support::Random random(17);
    std::vector<float> rows;
    constexpr int kRows = 4000;
    for (int i = 0; i < kRows; ++i) {
      for (std::size_t k = 0; k < c.operands; ++k) {
        const double x = is_signed ? random.number(-2, 2) : random.number(0, i % 5 == 0 ? 2 : 1);
        rows.push_back(static_cast<float>(i % 50 == 0 && k == 0 ? 0 : x));
      }
    }
    const std::vector<float> results = evaluate(c, rows);
    double worst = 0, worst_partial = 0;
    int smooth = 0;
    for (int i = 0; i < kRows; ++i) {
      const std::vector<double> x(rows.begin() + static_cast<std::ptrdiff_t>(i * c.operands),
                                  rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * c.operands));
      const float* r = &results[i * (1 + c.operands)];
      const FieldState e = exact(c.op, x);
      const double scale = std::max(1.0, std::abs(e.field.v));
      worst = std::max(worst, std::abs(r[0] - e.field.v) / scale);
      if (!is_smooth(c.op, x, e)) continue;
      ++smooth;
      const double partials[] = {e.field.d.x, e.field.d.y, e.field.d.z};
      for (std::size_t k = 0; k < c.operands; ++k) {
        worst_partial = std::max(worst_partial, std::abs(r[1 + k] - partials[k]) / std::max(1.0, length(e.field.d)));
      }
    }
    std::cout << c.name << ": values off by " << worst << ", partials by " << worst_partial << " at " << smooth
              << " smooth points\n";
    EXPECT_LE(worst, c.tolerance);
    EXPECT_LE(worst_partial, 2e-3);
    EXPECT_GE(smooth, kRows / 2);
  }
}

// Operators that follow an angle: two fields in space whose gradients have the angle and the ratio of the row.
TEST(Conformance, OperatorsThatFollowAnAngleAreTheSameOnTheDevice) {
  for (const Case& c : cases()) {
    if (!c.op.by_angle) continue;
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
    const std::vector<float> results = evaluate(c, rows);
    double worst = 0;
    for (int i = 0; i < kRows; ++i) {
      const float* a = &rows[4 * i];
      const double cosine = std::cos(double{a[2]}), sine = std::sin(double{a[2]});
      const FieldState first{Dual(a[0]), {Dual(double{a[3]}), Dual(0.0), Dual(0.0)}};
      const FieldState second{Dual(a[1]), {Dual(cosine), Dual(sine), Dual(0.0)}};
      const FieldState e = reference::combine({&c.op, Law::kSigned, 1}, {first, second});
      worst = std::max(worst, std::abs(results[4 * i] - e.field.v) / std::max(1.0, std::abs(e.field.v)));
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::isfinite(results[4 * i + k])) << "row " << i;
    }
    std::cout << c.name << ": values off by " << worst << "\n";
    EXPECT_LE(worst, c.tolerance);
  }
}

TEST(Conformance, PartialsByTheAngleAreDifferencesOfValues) {
  for (const Case& c : cases()) {
    if (!c.op.by_angle) continue;
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
    const std::vector<float> r = evaluate(c, rows);
    std::vector<double> errors;
    for (int i = 0; i < kRows; ++i) {
      const float* low = &r[12 * i];
      errors.push_back(std::abs((low[8] - low[0]) / (2 * kStep) - low[4 + 3]) / std::max(1.0f, std::abs(low[4 + 3])));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors[kRows * 95 / 100], 1e-2);  // the cosine's bend at a right angle, and the edge of the blend
  }
}

void expect_golden(const std::string& file, std::size_t operands,
                   const std::function<Operator(const std::vector<double>&)>& make) {
  ISOFIELD_NEEDS_SHARED("golden/" + file);
  const auto table = test_support::read_csv(test_support::shared_file("golden/" + file));
  ASSERT_TRUE(table.ok()) << table.status();
  double worst = 0;
  // Rows of the same parameters go together.
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
    const std::vector<float> results = evaluate({file, make(parameters), operands}, rows);
    for (std::size_t n = 0; n < places.size(); ++n) {
      worst = std::max(worst, std::abs(results[n * (1 + operands)] - table->rows[places[n]].back()));
    }
  }
  std::cout << file << ": max error " << worst << " of " << table->rows.size() << " rows\n";
  EXPECT_LE(worst, 1e-5);
}

TEST(Conformance, ReproducesGoldenBt2) {
  expect_golden("hsu_bt2.csv", 2, [](const std::vector<double>& p) {  // r1, r2, p, m1, m2
    Operator op = of_kind(Kind::kBt2);
    op.terms = {{p[0], 2, p[3]}, {p[1], 2, p[4]}};
    op.conic = p[2];
    return op;
  });
}

TEST(Conformance, ReproducesGoldenBtk) {
  expect_golden("hsu_btk.csv", 3, [](const std::vector<double>&) {
    Operator op = of_kind(Kind::kBtk);
    op.terms = {{1, 2, 1}, {0.7, 3, 0.5}, {1.3, 2.5, 2}};  // what the file was made with
    return op;
  });
}

}  // namespace
}  // namespace isofield::gpu_test
