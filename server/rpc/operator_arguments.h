// Describes which columns an operator takes in EvaluateOperator, and brings the rows of a request into the order that
// the engine takes.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/points/operator_evaluator.h"
#include "isofield/v1/operator_service.pb.h"

namespace isofield::rpc {

// The arguments that an operator takes.
struct ArgumentShape {
  // kEither is for max and min, which are the same functions for both laws.
  enum class Fields { kPositive, kSigned, kEither };
  Fields fields = Fields::kPositive;
  bool is_steered = false;  // takes theta or alpha
  bool by_angle = false;    // takes alpha, and may take ratio
  int least = 2, most = 2;  // the numbers of operands
};
ArgumentShape argument_shape(const operators::Operator& op);

// Returns the names of the arguments, as OperatorSummary states them.
std::vector<std::string> argument_names(const ArgumentShape& shape);

// The arguments of one request.
class OperatorArguments {
 public:
  using Columns = google::protobuf::RepeatedPtrField<std::string>;

  // Reads the rows of a request. INVALID_ARGUMENT: the columns, the tensor or a number is refused; for a number the
  // message states its column, row and value. RESOURCE_EXHAUSTED: there are more than max_rows.
  static absl::StatusOr<OperatorArguments> read(const ArgumentShape& shape, const Columns& columns,
                                                const v1::Tensor& tensor, std::uint64_t max_rows);
  // Reads the rows of a request for an opening function, which has the one column alpha.
  static absl::StatusOr<OperatorArguments> read_alphas(const Columns& columns, const v1::Tensor& tensor,
                                                       std::uint64_t max_rows);

  // Returns rows of x1 ... xk [, theta or alpha [, ratio]].
  std::span<const float> numbers() const { return numbers_; }
  std::size_t operands() const { return operands_; }
  std::size_t rows() const { return numbers_.size() / names_.size(); }
  engine::Steering steering() const { return steering_; }
  // Returns "g" and the names of its derivatives with respect to the fields and to theta or alpha.
  std::vector<std::string> result_columns() const;

 private:
  absl::Status fill(const Columns& columns, const v1::Tensor& tensor, std::uint64_t max_rows);

  std::vector<std::string> names_;  // the names of the columns of numbers_
  std::size_t operands_ = 0;
  engine::Steering steering_ = engine::Steering::kNone;
  std::vector<float> numbers_;
};

}  // namespace isofield::rpc
