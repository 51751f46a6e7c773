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

namespace {

template <std::size_t... I>
Operator of_index(std::size_t index, std::index_sequence<I...>) {
  Operator op;
  ((index == I ? (void)(op = Operator(std::variant_alternative_t<I, operators::Parameters>())) : (void)0), ...);
  return op;
}

template <class Terms, class Op>
std::span<Terms> terms_in(Op& op) {
  return std::visit(
      [](auto& kind) -> std::span<Terms> {
        if constexpr (requires { kind.terms; }) {
          return kind.terms;
        } else {
          return {};
        }
      },
      op.parameters);
}

}  // namespace

Operator of_kind(Kind kind) {
  constexpr std::size_t kCount = std::variant_size_v<operators::Parameters>;
  return of_index(static_cast<std::size_t>(kind), std::make_index_sequence<kCount>());
}

std::span<operators::Term> terms_of(Operator& op) {
  return terms_in<operators::Term>(op);
}
std::span<const operators::Term> terms_of(const Operator& op) {
  return terms_in<const operators::Term>(op);
}

std::vector<Case> cases() {
  using namespace operators;
  std::vector<Case> all;
  for (const Kind kind : {Kind::kSum, Kind::kMax, Kind::kMin, Kind::kDifference}) {
    all.push_back({"classic " + std::to_string(static_cast<int>(kind)), of_kind(kind)});
  }
  for (const double t : {1.0, 2.5, 64.0}) all.push_back({"ricci " + std::to_string(t), Ricci{t}});
  const BulgeElimination by_angle{.is_on = true};
  for (const Form form : {Form::kUnion, Form::kIntersection, Form::kDifference}) {
    const std::string suffix = form == Form::kUnion          ? ""
                               : form == Form::kIntersection ? " intersection"
                                                             : " difference";
    const auto add = [&](const std::string& name, Operator o, std::size_t operands = 2, double tolerance = 3e-6) {
      const bool has_all_forms = o.kind() == Kind::kClean || (o.kind() == Kind::kBt2 && !o.has_angular_ranges());
      if (few_kernels() && form != Form::kUnion && !has_all_forms) return;
      o.form = form;
      all.push_back({name + suffix, std::move(o), operands, tolerance});
    };
    // Next to its sharp edge the clean union's arcs shrink to nothing.
    add("clean", Clean{}, 2, 2e-5);
    for (const auto& [theta1, theta2] : {std::pair{0.0, 0.0}, {0.2, 0.6}, {0.7, 0.1}, {0.785, 0.785}}) {
      add("barthe " + std::to_string(theta1), Barthe{theta1, theta2});
    }
    add("bernhardt", Bernhardt{{0.3, 0.3}, 0.4}, 2, 2e-5);
    add("r_union", RUnion{});
    add("pasko", Pasko{-0.4, 0.7, 1.2});
    add("functional", Functional{SampledCurve({0.0, 0.2, 0.5, 1.1}, {0.5, 0.4, 0.1, 0.0})});
    // Two control points lie close together, the first lies beyond 0, and the last one is not 0.
    add("functional of uneven points", Functional{SampledCurve({0.1, 0.1005, 0.4, 0.9}, {0.3, 0.2998, 0.2, 0.25})});
    add("smooth_min", SmoothMin{0.6});
    const std::vector<Term> two{{0.8, 2, 1}, {1.1, 2, 1}};
    add("superelliptic", Superelliptic{2.5, two, {}});
    add("superelliptic by angle", Superelliptic{2.5, two, by_angle}, 2, 5e-5);
    Bt2 bt2;
    for (const double conic : {-2.0, 0.0, 0.9}) {
      for (const double m : {1.0, 0.3}) {
        bt2 = {{Term{1, 2, m}, Term{1.2, 2, 1}}, conic, {}};
        add("bt2 " + std::to_string(conic), bt2);
      }
    }
    bt2.elimination = by_angle;
    add("bt2 by angle", bt2, 2, 1e-5);
    add("btk of 3", Btk{{{1, 2, 1}, {0.7, 3, 0.4}, {1.3, 1.5, 2}}, {}}, 3, 1e-5);
    add("btk of 2", Btk{{{1, 2, 1}}, {}}, 2, 1e-5);
    add("btk by angle", Btk{{{1, 2, 0.5}, {0.8, 4, 1}}, by_angle}, 2, 2e-5);
  }
  return all;
}

std::vector<float> on_device(const Case& c, const std::vector<float>& arguments) {
  static engine::OperatorEvaluator evaluator(device(), kernels(), volumes());
  using engine::Steering;
  const Steering steering = c.op.has_angular_ranges() ? Steering::kAlpha
                            : c.op.is_steered()       ? Steering::kTheta
                                                      : Steering::kNone;
  const std::size_t steers = steering != Steering::kNone ? 1 : 0;
  const std::size_t columns = c.operands + steers + (c.op.has_angular_ranges() ? 1 : 0);
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
  return reference::combine({&op, op.law(), 1}, operands);
}

FieldState exact_at(const Operator& op, double x1, double x2, double alpha, double ratio) {
  const double cosine = std::cos(alpha), sine = std::sin(alpha);
  const FieldState first{Dual(x1, {1, 0, 0}), {Dual(ratio), Dual(0.0), Dual(0.0)}};
  const FieldState second{Dual(x2, {0, 1, 0}), {Dual(cosine, {0, 0, -sine}), Dual(sine, {0, 0, cosine}), Dual(0.0)}};
  return reference::combine({&op, op.law(), 1}, {first, second});
}

bool is_smooth(const Operator& op, const std::vector<double>& x, const FieldState& here) {
  // A form of positive fields is clamped where it is nearly 0.
  if (op.law() == Law::kPositive && here.field.v < 1e-6) return false;
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
  using namespace operators;
  if (const auto* k = op.as<Ricci>()) add("exponent", number(k->exponent));
  if (const auto* k = op.as<Barthe>()) add("theta1", degrees(k->theta1)), add("theta2", degrees(k->theta2));
  if (const auto* k = op.as<Bernhardt>()) {
    add("weight", number(k->weight));
    add("theta1", degrees(k->barthe.theta1));
    add("theta2", degrees(k->barthe.theta2));
  }
  if (const auto* k = op.as<Pasko>()) add("a0", number(k->a0)), add("a1", number(k->a1)), add("a2", number(k->a2));
  if (const auto* k = op.as<Functional>()) add("x", list(k->h.x(), itself)), add("h", list(k->h.y(), itself));
  if (const auto* k = op.as<Bt2>()) {
    add("r1", number(k->term(0).range));
    add("r2", number(k->term(1).range));
    add("p", number(k->conic));
    add("m1", number(k->term(0).weight));
    add("m2", number(k->term(1).weight));
  }
  if (const auto* k = op.as<SmoothMin>()) add("radius", number(k->radius));
  if (op.is_joint()) add("ranges", list(terms_of(op), range));
  if (const auto* k = op.as<Superelliptic>()) add("exponent", number(k->exponent));
  if (const auto* k = op.as<Btk>()) {
    add("powers", list(k->terms, [](const Term& t) { return t.power; }));
    add("weights", list(k->terms, [](const Term& t) { return t.weight; }));
  }
  EXPECT_FALSE(op.is_steered()) << "not an operator of cases()";
  op.visit([&](const auto& k) {
    if constexpr (requires { k.elimination; }) {
      if (!k.elimination.is_on) return;
      add(op.kind() == Kind::kSuperelliptic ? "by_angle" : "eliminate_bulge", "true");
      add("omega", number(k.elimination.omega));
    }
  });
  if (op.traits().has_form && op.form == Form::kIntersection) add("form", "\"INTERSECTION\"");
  if (op.traits().has_form && op.form == Form::kDifference) add("form", "\"DIFFERENCE\"");
  return absl::StrCat("{", name.empty() ? "" : absl::StrCat("\"name\": \"", name, "\", "), "\"",
                      std::string(op.traits().name), "\": {", fields, "}}");
}

}  // namespace isofield::gpu_test
