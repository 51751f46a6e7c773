// Every composition operator with parameters that show what it does, by itself: at rows of field values on the device
// and in double precision, and as a node of a scene.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "operators/operator.h"
#include "reference/field_state.h"

namespace isofield::gpu_test {

struct Case {
  std::string name;
  operators::Operator op;
  std::size_t operands = 2;
  // Values may differ by so much times max(1, |exact|), partials by so much more.
  double tolerance = 3e-6;
};

// With its parameters' defaults.
operators::Operator of_kind(operators::Kind kind);

// The terms of an operator with individual ranges; none of others.
std::span<operators::Term> terms_of(operators::Operator& op);
std::span<const operators::Term> terms_of(const operators::Operator& op);

// All but the gradient blend, with all their forms.
std::vector<Case> cases();

// Rows of the value, its partials by the fields and by what steers the operator. A row of `arguments` holds the fields
// and, of the gradient blend, theta; of operators that follow an angle that angle and the ratio of the gradients'
// lengths.
std::vector<float> on_device(const Case& c, const std::vector<float>& arguments);

// The operator on fields whose derivatives are such that the result's tells the partials: at most three.
reference::FieldState exact(const operators::Operator& op, const std::vector<double>& x);
// Of two fields whose gradients have this angle and ratio of lengths: the derivatives are those by the fields and by
// the angle.
reference::FieldState exact_at(const operators::Operator& op, double x1, double x2, double alpha, double ratio);

// Whether the partials hold still around x. Where they jump or bend sharply float32 cannot follow.
bool is_smooth(const operators::Operator& op, const std::vector<double>& x, const reference::FieldState& here);

// The operator as a node in the scene's JSON; of operators of `cases()`.
std::string operator_node(const operators::Operator& op, const std::vector<std::string>& children,
                          const std::string& name = "");

}  // namespace isofield::gpu_test
