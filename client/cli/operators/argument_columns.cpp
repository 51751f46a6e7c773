#include "operators/argument_columns.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>

#include "excerpt.h"

namespace isofield {
namespace {

constexpr int kMostOperands = 16;

using Law = OperatorArity::Law;

absl::Status refuse(const std::vector<std::string>& there, const std::string& expected) {
  return absl::InvalidArgumentError(
      absl::StrCat("the columns are ", excerpt(absl::StrJoin(there, ", ")), "; expected ", expected));
}

}  // namespace

OperatorArity arity_of(const v1::Operator& message) {
  switch (message.kind_case()) {
    case v1::Operator::kMax:
    case v1::Operator::kMin:
      return {Law::kEither};
    case v1::Operator::kGradient:
    case v1::Operator::kSampled:
      return {Law::kPositive, true};
    case v1::Operator::kRUnion:
    case v1::Operator::kPasko:
    case v1::Operator::kFunctional:
      return {Law::kSigned};
    case v1::Operator::kSuperelliptic:
      return {Law::kSigned, false, message.superelliptic().by_angle()};
    case v1::Operator::kBt2:
      return {Law::kSigned, false, message.bt2().eliminate_bulge()};
    case v1::Operator::kBtk:
      return {Law::kSigned, false, message.btk().eliminate_bulge()};
    default:
      return {};
  }
}

absl::StatusOr<std::vector<std::string>> choose_columns(const v1::Operator& message,
                                                        const std::vector<std::string>& there) {
  const auto has = [&](const std::string& name) { return std::find(there.begin(), there.end(), name) != there.end(); };
  const OperatorArity arity = arity_of(message);
  const bool is_signed = arity.law == Law::kSigned || (arity.law == Law::kEither && !has("f1"));
  const char* const fields = arity.law == Law::kEither ? "f1 and f2, or x1 and x2"
                             : is_signed               ? "x1, x2 ..."
                                                       : "f1 and f2";
  std::vector<std::string> chosen;
  for (int i = 1; i <= (arity.law == Law::kSigned ? kMostOperands : 2); ++i) {
    std::string name = absl::StrCat(is_signed ? "x" : "f", i);
    if (!has(name)) break;
    chosen.push_back(std::move(name));
  }
  if (chosen.empty() || (chosen.size() < 2 && !is_signed)) return refuse(there, fields);
  if (arity.is_steered) {
    if (has("theta") == has("alpha")) {
      return refuse(there, has("theta") ? "theta or alpha, not both"
                                        : "theta or alpha (radians) besides f1 and f2: it steers this operator");
    }
    chosen.push_back(has("theta") ? "theta" : "alpha");
  }
  if (arity.by_angle) {
    if (!has("alpha")) return refuse(there, absl::StrCat("alpha (radians) besides ", fields));
    chosen.push_back("alpha");
    if (has("ratio")) chosen.push_back("ratio");
  }
  return chosen;
}

absl::StatusOr<std::vector<std::size_t>> places_of(const std::vector<std::string>& columns,
                                                   const std::vector<std::string>& there) {
  std::vector<std::size_t> places;
  for (const std::string& column : columns) {
    const auto found = std::find(there.begin(), there.end(), column);
    if (std::count(found, there.end(), column) != 1) return refuse(there, absl::StrCat(column, " once"));
    places.push_back(static_cast<std::size_t>(found - there.begin()));
  }
  return places;
}

}  // namespace isofield
