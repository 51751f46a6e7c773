#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

#include "isofield/v1/operator.pb.h"

namespace isofield {

// What the kind of an operator means for its arguments (operator_service.proto, EvaluateOperatorRequest.columns).
struct OperatorArity {
  enum class Law { kPositive, kSigned, kEither } law = Law::kPositive;
  bool is_steered = false;  // by theta or alpha
  bool by_angle = false;    // by alpha, and ratio where it is stated
};
OperatorArity arity_of(const v1::Operator& message);

// Those of the columns there are that the operator takes, in order. INVALID_ARGUMENT: one is missing, or theta and
// alpha are both there; says what is expected.
absl::StatusOr<std::vector<std::string>> choose_columns(const v1::Operator& message,
                                                        const std::vector<std::string>& there);

// The place of each of `columns` in `there`, a table's columns. INVALID_ARGUMENT: one of them is not there exactly
// once; the message lists the names.
absl::StatusOr<std::vector<std::size_t>> places_of(const std::vector<std::string>& columns,
                                                   const std::vector<std::string>& there);

}  // namespace isofield
