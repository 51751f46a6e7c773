#include "gpu/operator_cases.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "engine/points/operator_evaluator.h"
#include "gpu/gpu_environment.h"

namespace isofield::gpu_test {

using operators::Form;
using operators::Kind;
using operators::Law;
using operators::Operator;
using reference::Dual;
using reference::FieldState;

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
      const bool has_all_forms = o.kind == Kind::kClean || (o.kind == Kind::kBt2 && !o.by_angle);
      if (few_kernels() && form != Form::kUnion && !has_all_forms) return;
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
    op = of_kind(Kind::kFunctional);
    op.curve = operators::SampledCurve({0.0, 0.2, 0.5, 1.1}, {0.5, 0.4, 0.1, 0.0});
    add("functional", op);
    // Control points close together, the first beyond 0, and a last one that is not 0.
    op.curve = operators::SampledCurve({0.1, 0.1005, 0.4, 0.9}, {0.3, 0.2998, 0.2, 0.25});
    add("functional of uneven points", op);
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
  return all;
}

std::vector<float> on_device(const Case& c, const std::vector<float>& arguments) {
  static engine::OperatorEvaluator evaluator(device(), kernels(), volumes());
  using engine::Steering;
  const Steering steering = c.op.by_angle ? Steering::kAlpha : c.op.is_steered() ? Steering::kTheta : Steering::kNone;
  const std::size_t steers = steering != Steering::kNone ? 1 : 0;
  const std::size_t columns = c.operands + steers + (c.op.by_angle ? 1 : 0);
  std::vector<float> results(arguments.size() / columns * (1 + c.operands + steers));
  const absl::Status status =
      evaluator.evaluate(std::make_shared<const Operator>(c.op), c.operands, steering, arguments, results);
  EXPECT_TRUE(status.ok()) << status;
  return results;
}

FieldState exact(const Operator& op, const std::vector<double>& x) {
  std::vector<FieldState> operands;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const blobtree::dvec3 unit{i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0};
    operands.push_back({Dual(x[i], unit), {Dual(unit.x), Dual(unit.y), Dual(unit.z)}});
  }
  return reference::combine({&op, operators::law_of(op.kind), 1}, operands);
}

FieldState exact_at(const Operator& op, double x1, double x2, double alpha, double ratio) {
  const double cosine = std::cos(alpha), sine = std::sin(alpha);
  const FieldState first{Dual(x1, {1, 0, 0}), {Dual(ratio), Dual(0.0), Dual(0.0)}};
  const FieldState second{Dual(x2, {0, 1, 0}), {Dual(cosine, {0, 0, -sine}), Dual(sine, {0, 0, cosine}), Dual(0.0)}};
  return reference::combine({&op, operators::law_of(op.kind), 1}, {first, second});
}

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

std::string operator_node(const Operator& op, const std::vector<std::string>& children, const std::string& name) {
  const auto number = [](double x) { return absl::StrFormat("%.17g", x); };
  const auto degrees = [&](double radians) { return number(radians * 180 / std::numbers::pi); };
  const auto list = [&](const auto& values, const auto& of) {
    return absl::StrCat(
        "[", absl::StrJoin(values, ", ", [&](std::string* out, const auto& v) { *out += number(of(v)); }), "]");
  };
  const auto itself = [](double x) { return x; };
  std::string fields = absl::StrCat("\"children\": [\"", absl::StrJoin(children, "\", \""), "\"]");
  const auto add = [&](const char* field, const std::string& value) {
    absl::StrAppend(&fields, ", \"", field, "\": ", value);
  };
  const auto range = [](const operators::Term& t) { return t.range; };
  const char* kind = "";
  switch (op.kind) {
    case Kind::kSum:
      kind = "sum";
      break;
    case Kind::kMax:
      kind = "max";
      break;
    case Kind::kMin:
      kind = "min";
      break;
    case Kind::kDifference:
      kind = "difference";
      break;
    case Kind::kRicci:
      kind = "ricci";
      add("exponent", number(op.exponent));
      break;
    case Kind::kClean:
      kind = "clean";
      break;
    case Kind::kBernhardt:
      add("weight", number(op.weight));
      [[fallthrough]];
    case Kind::kBarthe:
      kind = op.kind == Kind::kBarthe ? "barthe" : "bernhardt";
      add("theta1", degrees(op.theta1));
      add("theta2", degrees(op.theta2));
      break;
    case Kind::kRUnion:
      kind = "r_union";
      break;
    case Kind::kPasko:
      kind = "pasko";
      add("a0", number(op.a0));
      add("a1", number(op.a1));
      add("a2", number(op.a2));
      break;
    case Kind::kSuperelliptic:
      kind = "superelliptic";
      add("exponent", number(op.exponent));
      add("ranges", list(op.terms, range));
      break;
    case Kind::kFunctional:
      kind = "functional";
      add("x", list(op.curve.x(), itself));
      add("h", list(op.curve.y(), itself));
      break;
    case Kind::kBt2:
      kind = "bt2";
      add("r1", number(op.term(0).range));
      add("r2", number(op.term(1).range));
      add("p", number(op.conic));
      add("m1", number(op.term(0).weight));
      add("m2", number(op.term(1).weight));
      break;
    case Kind::kBtk:
      kind = "btk";
      add("ranges", list(op.terms, range));
      add("powers", list(op.terms, [](const operators::Term& t) { return t.power; }));
      add("weights", list(op.terms, [](const operators::Term& t) { return t.weight; }));
      break;
    case Kind::kGradient:
    case Kind::kSampled:
      ADD_FAILURE() << "not an operator of cases()";
  }
  if (op.by_angle) {
    add(op.kind == Kind::kSuperelliptic ? "by_angle" : "eliminate_bulge", "true");
    add("omega", number(op.omega));
  }
  if (op.form == Form::kIntersection) add("form", "\"INTERSECTION\"");
  if (op.form == Form::kDifference) add("form", "\"DIFFERENCE\"");
  return absl::StrCat("{", name.empty() ? "" : absl::StrCat("\"name\": \"", name, "\", "), "\"", kind, "\": {", fields,
                      "}}");
}

}  // namespace isofield::gpu_test
