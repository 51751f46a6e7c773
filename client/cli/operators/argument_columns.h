#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

#include "isofield/v1/operator.pb.h"

namespace isofield {

// Says which arguments an operator takes (operator_service.proto, EvaluateOperatorRequest.columns).
struct OperatorArity {
  // The kind of fields that the operator combines: positive ones (columns f1, f2), signed ones (x1, x2 ...), or either.
  enum class Law { kPositive, kSigned, kEither } law = Law::kPositive;
  bool is_steered = false;  // it takes theta or alpha
  bool by_angle = false;    // it takes alpha and, if stated, ratio
};
// Returns the arity that the kind and the parameters of an operator determine.
OperatorArity arity_of(const v1::Operator& message);

// Chooses those of the columns `there` that the operator takes, in its own order. INVALID_ARGUMENT: one is missing, or
// an operator that takes theta or alpha is given both; the message says what is expected.
absl::StatusOr<std::vector<std::string>> choose_columns(const v1::Operator& message,
                                                        const std::vector<std::string>& there);

// Returns the place of each of `columns` in `there`, the columns of a table. INVALID_ARGUMENT: one of them is not there
// exactly once; the message lists the names.
absl::StatusOr<std::vector<std::size_t>> places_of(const std::vector<std::string>& columns,
                                                   const std::vector<std::string>& there);

}  // namespace isofield
