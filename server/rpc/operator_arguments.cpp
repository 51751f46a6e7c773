#include "rpc/operator_arguments.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/quoted.h"
#include "base/status_macros.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

using Fields = ArgumentShape::Fields;

// Angles may lie beyond the ends of their range by this much, in radians, since float32 does not hold the ends exactly.
constexpr float kAngleTolerance = 1e-5f;
constexpr float kMostTheta = std::numbers::pi_v<float> / 4;
constexpr float kMostAlpha = std::numbers::pi_v<float>;

bool contains(const OperatorArguments::Columns& columns, const std::string& name) {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

// Tells whether an operator is the same function for both laws.
bool is_of_either_law(const operators::Operator& op) {
  using operators::Law;
  return op.takes_either_law() && op.opcode(Law::kPositive) == op.opcode(Law::kSigned);
}

std::string expected_columns(const ArgumentShape& shape) {
  std::string fields = "f1 and f2";
  if (shape.fields == Fields::kSigned) {
    fields = shape.least < shape.most ? absl::StrCat("x1 to xk, k within [", shape.least, ", ", shape.most, "]")
             : shape.most == 2        ? "x1 and x2"
                                      : absl::StrCat("x1 to x", shape.most);
  }
  if (shape.fields == Fields::kEither) fields = "f1 and f2, or x1 and x2";
  if (shape.is_steered) return absl::StrCat(fields, ", and one of theta and alpha");
  if (shape.by_angle) return absl::StrCat(fields, ", alpha, and optionally ratio");
  return fields;
}

absl::Status refuse_columns(const OperatorArguments::Columns& columns, const std::string& expected) {
  std::string stated;
  for (int i = 0; i < columns.size() && i < 20; ++i) {
    absl::StrAppend(&stated, i > 0 ? ", " : "", base::printable(columns[i], 32));
  }
  return absl::InvalidArgumentError(
      absl::StrCat("columns = [", stated, columns.size() > 20 ? ", ..." : "", "]: expected ", expected));
}

// Operators add fields, and larger ones would leave the range of float32.
constexpr float kMostField = 1e36f;

// The range of the numbers in a column. An angle that lies beyond an end by rounding is moved to the end.
struct Range {
  float least, most;
  bool open = false;  // `least` itself is not in the range
  const char* expected;

  static Range of(const std::string& column) {
    constexpr float kHuge = std::numeric_limits<float>::max();
    if (column == "theta") return {0, kMostTheta, false, "radians within [0, pi/4]"};
    if (column == "alpha") return {0, kMostAlpha, false, "radians within [0, pi]"};
    if (column == "ratio") return {0, kHuge, true, "a finite float32 > 0"};
    if (column[0] == 'f') return {0, kMostField, false, "a finite float32 >= 0 of at most 1e36"};
    return {-kMostField, kMostField, false, "a finite float32 of magnitude at most 1e36"};
  }
  bool admit(float& x) const {
    if (most < 4 && x > most && x <= most + kAngleTolerance) x = most;
    if (most < 4 && x < 0 && x >= -kAngleTolerance) x = 0;
    return x <= most && (open ? x > least : x >= least);  // false for NaN
  }
};

}  // namespace

ArgumentShape argument_shape(const operators::Operator& op) {
  ArgumentShape shape;
  if (is_of_either_law(op)) shape.fields = Fields::kEither;
  if (op.law() == operators::Law::kSigned) shape.fields = Fields::kSigned;
  shape.is_steered = op.is_steered();
  shape.by_angle = op.has_angular_ranges();
  if (op.is_joint()) {
    const operators::OperandCount count = op.operand_count();
    // Such an operator also takes a single operand, and then returns what this operand alone contributes.
    shape.least = count.least == count.most ? static_cast<int>(count.least) : 1;
    shape.most = static_cast<int>(count.most);
  }
  return shape;
}

std::vector<std::string> argument_names(const ArgumentShape& shape) {
  std::vector<std::string> names;
  const int operands = shape.least < shape.most ? 2 : shape.most;
  for (int i = 1; i <= operands; ++i) names.push_back(absl::StrCat(shape.fields == Fields::kSigned ? "x" : "f", i));
  if (shape.is_steered) names.push_back("theta");
  if (shape.by_angle) names.insert(names.end(), {"alpha", "ratio"});
  return names;
}

absl::StatusOr<OperatorArguments> OperatorArguments::read(const ArgumentShape& shape, const Columns& columns,
                                                          const v1::Tensor& tensor, std::uint64_t max_rows) {
  OperatorArguments arguments;
  const bool is_signed =
      shape.fields == Fields::kSigned || (shape.fields == Fields::kEither && contains(columns, "x1"));
  const char* const letter = is_signed ? "x" : "f";
  for (int i = 1; i <= shape.most; ++i) {
    std::string name = absl::StrCat(letter, i);
    if (i > shape.least && !contains(columns, name)) break;
    arguments.names_.push_back(std::move(name));
  }
  arguments.operands_ = arguments.names_.size();
  if (shape.is_steered || shape.by_angle) {
    const bool by_theta = shape.is_steered && contains(columns, "theta");
    arguments.steering_ = by_theta ? engine::Steering::kTheta : engine::Steering::kAlpha;
    arguments.names_.push_back(by_theta ? "theta" : "alpha");
  }
  if (shape.by_angle) arguments.names_.push_back("ratio");
  // Each column must be one that the operator takes, and must occur once. Only the ratio may be missing.
  int found = 0;
  for (const std::string& name : arguments.names_) {
    if (contains(columns, name)) {
      ++found;
    } else if (name != "ratio") {
      return refuse_columns(columns, expected_columns(shape));
    }
  }
  if (found != columns.size()) return refuse_columns(columns, expected_columns(shape) + ", each once");
  ISOFIELD_RETURN_IF_ERROR(arguments.fill(columns, tensor, max_rows));
  return arguments;
}

absl::StatusOr<OperatorArguments> OperatorArguments::read_alphas(const Columns& columns, const v1::Tensor& tensor,
                                                                 std::uint64_t max_rows) {
  if (columns.size() != 1 || columns[0] != "alpha") return refuse_columns(columns, "alpha alone");
  OperatorArguments arguments;
  arguments.names_ = {"alpha"};
  ISOFIELD_RETURN_IF_ERROR(arguments.fill(columns, tensor, max_rows));
  return arguments;
}

absl::Status OperatorArguments::fill(const Columns& columns, const v1::Tensor& tensor, std::uint64_t max_rows) {
  const std::size_t stated = columns.size();
  ISOFIELD_ASSIGN_OR_RETURN(const RowArray array,
                            RowArray::read(tensor, stated, max_rows, {"arguments", "rows", "send several requests"}));
  const std::size_t rows = array.numbers().size() / stated, width = names_.size();
  numbers_.resize(rows * width);
  for (std::size_t to = 0; to < width; ++to) {
    const auto place = std::find(columns.begin(), columns.end(), names_[to]);
    const std::size_t from = place - columns.begin();
    const Range range = Range::of(names_[to]);
    for (std::size_t row = 0; row < rows; ++row) {
      float& x = numbers_[row * width + to];
      x = from < stated ? array.numbers()[row * stated + from] : 1.0f;  // the ratio, where it is absent
      if (!range.admit(x)) {
        return absl::InvalidArgumentError(
            absl::StrCat("arguments[", row, "].", names_[to], " = ", x, ": expected ", range.expected));
      }
    }
  }
  return absl::OkStatus();
}

std::vector<std::string> OperatorArguments::result_columns() const {
  std::vector<std::string> columns{"g"};
  for (const std::string& name : names_) {
    if (name != "ratio") columns.push_back("dg_d" + name);
  }
  return columns;
}

}  // namespace isofield::rpc
