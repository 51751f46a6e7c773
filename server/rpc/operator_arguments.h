// What an operator takes in EvaluateOperator: its columns, and the rows of a request brought into the engine's order.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/points/operator_evaluator.h"
#include "isofield/v1/operator_service.pb.h"

namespace isofield::rpc {

struct ArgumentShape {
  // kEither: max and min, which are the same of both laws.
  enum class Fields { kPositive, kSigned, kEither };
  Fields fields = Fields::kPositive;
  bool is_steered = false;  // takes theta or alpha
  bool by_angle = false;    // takes alpha, and may take ratio
  int least = 2, most = 2;  // operands
};
ArgumentShape argument_shape(const operators::Operator& op);

// As OperatorSummary states them.
std::vector<std::string> argument_names(const ArgumentShape& shape);

class OperatorArguments {
 public:
  using Columns = google::protobuf::RepeatedPtrField<std::string>;

  // INVALID_ARGUMENT: the columns, the tensor or a number; names column, row and value. RESOURCE_EXHAUSTED: more than
  // max_rows.
  static absl::StatusOr<OperatorArguments> read(const ArgumentShape& shape, const Columns& columns,
                                                const v1::Tensor& tensor, std::uint64_t max_rows);
  // Of an opening: the one column alpha.
  static absl::StatusOr<OperatorArguments> read_alphas(const Columns& columns, const v1::Tensor& tensor,
                                                       std::uint64_t max_rows);

  // Rows of x1 ... xk [, theta or alpha [, ratio]].
  std::span<const float> numbers() const { return numbers_; }
  std::size_t operands() const { return operands_; }
  std::size_t rows() const { return numbers_.size() / names_.size(); }
  engine::Steering steering() const { return steering_; }
  // "g", and its derivatives by fields and steering.
  std::vector<std::string> result_columns() const;

 private:
  absl::Status fill(const Columns& columns, const v1::Tensor& tensor, std::uint64_t max_rows);

  std::vector<std::string> names_;  // of the columns of numbers_
  std::size_t operands_ = 0;
  engine::Steering steering_ = engine::Steering::kNone;
  std::vector<float> numbers_;
};

}  // namespace isofield::rpc
