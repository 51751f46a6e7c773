#include "blobtree/operator_reader.h"

#include <absl/strings/str_cat.h>

namespace isofield::blobtree {
namespace {

constexpr double kRadians = 0.017453292519943295;

operators::Opening opening_of(const v1::Opening& m) {
  operators::Opening o = operators::camel();
  if (m.preset() == v1::Opening::ORGANIC) o = operators::organic();
  if (m.preset() == v1::Opening::CONTACT) o = operators::contact();
  if (m.has_theta0()) o.theta0 = m.theta0() * kRadians;
  if (m.has_theta1()) o.theta1 = m.theta1() * kRadians;
  if (m.has_theta2()) o.theta2 = m.theta2() * kRadians;
  return o;
}

}  // namespace

// A stand-in until the reader of all operators is there.
absl::StatusOr<std::shared_ptr<const operators::Operator>> read_operator(const v1::Operator& message) {
  operators::Operator op;
  switch (message.kind_case()) {
    case v1::Operator::kSum:
      op.kind = operators::Kind::kSum;
      break;
    case v1::Operator::kMin:
      op.kind = operators::Kind::kMin;
      break;
    case v1::Operator::kRicci:
      if (!(message.ricci().exponent() >= 1)) {
        return absl::InvalidArgumentError(
            absl::StrCat("ricci.exponent = ", message.ricci().exponent(), ": expected an exponent within [1, 64]"));
      }
      op.kind = operators::Kind::kRicci;
      break;
    case v1::Operator::kGradient:
      op.kind = operators::Kind::kGradient;
      op.opening = opening_of(message.gradient().opening());
      if (message.gradient().silhouette().kind() == v1::Silhouette::BULGE) {
        const double k = message.gradient().silhouette().k();
        if (!(k >= 0 && k <= 1)) {
          return absl::InvalidArgumentError(
              absl::StrCat("gradient.silhouette.k = ", k, ": expected a strength within [0, 1]"));
        }
        op.silhouette = {operators::Silhouette::Kind::kBulge, k};
      }
      break;
    case v1::Operator::kBt2:
      op.kind = operators::Kind::kBt2;
      op.by_angle = message.bt2().eliminate_bulge();
      op.terms = {{message.bt2().r1()}, {message.bt2().r2()}};
      break;
    case v1::Operator::kBtk:
      op.kind = operators::Kind::kBtk;
      op.by_angle = message.btk().eliminate_bulge();
      for (const double r : message.btk().ranges()) op.terms.push_back({r});
      break;
    case v1::Operator::kSampled:
      op.kind = operators::Kind::kSampled;
      if (message.sampled().size() < 2) {
        return absl::InvalidArgumentError(
            absl::StrCat("sampled.size = ", message.sampled().size(), ": expected a size within [2, 128]"));
      }
      break;
    case v1::Operator::KIND_NOT_SET:
      return absl::InvalidArgumentError("kind = (absent): expected one of sum, max, ..., sampled");
    default:
      op.kind = operators::Kind::kMax;
  }
  return std::make_shared<const operators::Operator>(std::move(op));
}

}  // namespace isofield::blobtree
