// Gives the composition operators with parameters that show what it does. Each is evaluated by itself, at rows of field
// values on the device and in double precision, and as a node of a scene.
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
  // Values may differ by this much times max(1, |exact|).
  double tolerance = 3e-6;
};

// Returns an operator with its parameters' defaults.
operators::Operator of_kind(operators::Kind kind);

// Returns the terms of an operator with individual ranges; the list is empty for other operators.
std::span<operators::Term> terms_of(operators::Operator& op);
std::span<const operators::Term> terms_of(const operators::Operator& op);

// Returns all operators but the gradient blend and the sampled one, with all their forms (few with few_kernels()).
std::vector<Case> cases();

// Evaluates an operator on the device. The result has rows of the value, its partials by the fields and by what steers
// the operator. A row of `arguments` holds the fields and, for the gradient blend, theta; for operators that follow an
// angle, that angle and the ratio of the gradients' lengths.
std::vector<float> on_device(const Case& c, const std::vector<float>& arguments);

// Evaluates the operator on at most three fields. The fields' derivatives are such that those of the result are the
// operator's partials.
reference::FieldState exact(const operators::Operator& op, const std::vector<double>& x);
// Evaluates the operator on two fields whose gradients have this angle and ratio of lengths. The derivatives of the
// result are those by the fields and by the angle.
reference::FieldState exact_at(const operators::Operator& op, double x1, double x2, double alpha, double ratio);

// Returns whether the partials hold still around x. Float32 cannot follow them where they jump or bend sharply.
bool is_smooth(const operators::Operator& op, const std::vector<double>& x, const reference::FieldState& here);

// Returns the operator as a node in the scene's JSON. It must be an operator of `cases()`.
std::string operator_node(const operators::Operator& op, const std::vector<std::string>& children,
                          const std::string& name = "");

}  // namespace isofield::gpu_test
