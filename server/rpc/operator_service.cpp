#include "rpc/operator_service.h"

#include <optional>

#include "base/quoted.h"
#include "base/status_macros.h"
#include "blobtree/scene/operator_reader.h"
#include "catalog/built_in_operators.h"
#include "catalog/pages.h"
#include "rpc/answer_limit.h"
#include "rpc/geometry_arguments.h"
#include "rpc/operator_arguments.h"
#include "rpc/tensor.h"
#include "scenes/opening_pick.h"

namespace isofield::rpc {
namespace {

// A summary holds at most this many bytes of an operator's description.
constexpr std::size_t kMostDescription = 1024;

void fill_summary(const std::string& name, std::uint64_t version, const v1::Operator& message,
                  const operators::Operator& op, v1::OperatorSummary& summary) {
  const ArgumentShape shape = argument_shape(op);
  summary.set_name(name);
  summary.set_version(version);
  summary.set_kind(catalog::kind_name(message));
  if (shape.fields == ArgumentShape::Fields::kPositive) summary.set_law(v1::POSITIVE);
  if (shape.fields == ArgumentShape::Fields::kSigned) summary.set_law(v1::SIGNED);
  for (std::string& argument : argument_names(shape)) summary.add_arguments(std::move(argument));
  summary.set_description(std::string(base::utf8_prefix(message.description(), kMostDescription)));
}

void fill_summary(const catalog::OperatorEntry& entry, const engine::VolumeCache& volumes,
                  v1::OperatorSummary& summary) {
  fill_summary(entry.name, entry.version, *entry.message, *entry.op, summary);
  summary.set_device_bytes(volumes.resident_bytes(*entry.op));
}

}  // namespace

absl::Status OperatorService::put(const v1::PutOperatorRequest& request, v1::PutOperatorResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(auto op, blobtree::read_operator(request.operator_()));
  ISOFIELD_ASSIGN_OR_RETURN(const catalog::OperatorEntry entry,
                            operators_.put(request.name(), request.operator_(), std::move(op)));
  fill_summary(entry, engine_.volumes(), *response.mutable_summary());
  return absl::OkStatus();
}

absl::Status OperatorService::get(const v1::GetOperatorRequest& request, v1::GetOperatorResponse& response) {
  if (std::optional<v1::Operator> built_in = catalog::built_in_operator(request.name())) {
    fill_summary(request.name(), 0, *built_in, blobtree::unread_operator(*built_in), *response.mutable_summary());
    *response.mutable_operator_() = *std::move(built_in);
    return absl::OkStatus();
  }
  ISOFIELD_ASSIGN_OR_RETURN(const catalog::OperatorEntry entry, operators_.get(request.name()));
  // The size is checked before the operator is copied, and again with the summary.
  ISOFIELD_RETURN_IF_ERROR(
      AnswerLimit(request.max_answer_bytes()).admit(entry.message->ByteSizeLong(), kLargerMessages));
  fill_summary(entry, engine_.volumes(), *response.mutable_summary());
  *response.mutable_operator_() = *entry.message;
  return absl::OkStatus();
}

absl::Status OperatorService::list(const v1::ListOperatorsRequest& request, v1::ListOperatorsResponse& response) {
  AnswerPage page;
  const auto add = [&](v1::OperatorSummary summary) {
    if (!page.admit(summary.ByteSizeLong())) return false;
    *response.add_operators() = std::move(summary);
    return true;
  };
  for (const std::string& name : catalog::built_in_names()) {
    if (!request.after().empty()) break;
    v1::OperatorSummary summary;
    const v1::Operator message = *catalog::built_in_operator(name);
    fill_summary(name, 0, message, blobtree::unread_operator(message), summary);
    add(std::move(summary));  // the built-in ones always fit
  }
  const auto add_custom = [&](const catalog::OperatorEntry& entry) -> absl::StatusOr<bool> {
    v1::OperatorSummary summary;
    fill_summary(entry, engine_.volumes(), summary);
    const bool has_room = add(std::move(summary));
    response.set_has_more(!has_room);
    return has_room;
  };
  return catalog::for_each_after(operators_, request.after(), add_custom);
}

absl::Status OperatorService::remove(const v1::DeleteOperatorRequest& request) {
  return operators_.remove(request.name());
}

absl::Status OperatorService::evaluate_opening(Call& call, const v1::EvaluateOperatorRequest& request,
                                               v1::EvaluateOperatorResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const operators::Opening opening, blobtree::read_opening(request.opening()));
  ISOFIELD_ASSIGN_OR_RETURN(
      const OperatorArguments alphas,
      OperatorArguments::read_alphas(request.columns(), request.arguments(), limits_.max_points_per_message));
  response.add_columns("theta");
  response.add_columns("dtheta_dalpha");
  ISOFIELD_RETURN_IF_ERROR(check_answer_rows(request, alphas.rows(), 2 * sizeof(float)));
  ISOFIELD_RETURN_IF_ERROR(call.admit(alphas.rows()));
  const std::span<float> out = make_float_tensor({alphas.rows(), 2}, *response.mutable_results());
  if (out.empty()) return absl::OkStatus();
  return engine_.operators().evaluate_opening(opening, alphas.numbers(), out);
}

absl::StatusOr<std::shared_ptr<const operators::Operator>> OperatorService::choose(
    const v1::EvaluateOperatorRequest& request) const {
  std::optional<v1::Operator> built_in;
  switch (request.operator_case()) {
    case v1::EvaluateOperatorRequest::kName:
      built_in = catalog::built_in_operator(request.name());
      if (!built_in) {
        ISOFIELD_ASSIGN_OR_RETURN(catalog::OperatorEntry entry, operators_.get(request.name()));
        return std::move(entry.op);
      }
      break;
    case v1::EvaluateOperatorRequest::kInline:
      break;
    default:
      return absl::InvalidArgumentError("operator: expected a name, an inline operator, or an opening");
  }
  const v1::Operator& message = built_in ? *built_in : request.inline_();
  return blobtree::read_operator(message);
}

absl::Status OperatorService::evaluate(Call& call, const v1::EvaluateOperatorRequest& request,
                                       v1::EvaluateOperatorResponse& response) {
  if (request.operator_case() == v1::EvaluateOperatorRequest::kOpening) {
    return evaluate_opening(call, request, response);
  }
  ISOFIELD_ASSIGN_OR_RETURN(const auto op, choose(request));
  ISOFIELD_ASSIGN_OR_RETURN(const OperatorArguments arguments,
                            OperatorArguments::read(argument_shape(*op), request.columns(), request.arguments(),
                                                    limits_.max_points_per_message));
  const std::vector<std::string> columns = arguments.result_columns();
  response.mutable_columns()->Assign(columns.begin(), columns.end());
  ISOFIELD_RETURN_IF_ERROR(check_answer_rows(request, arguments.rows(), columns.size() * sizeof(float)));
  ISOFIELD_RETURN_IF_ERROR(call.admit(arguments.rows()));
  const std::span<float> out = make_float_tensor({arguments.rows(), columns.size()}, *response.mutable_results());
  if (out.empty()) return absl::OkStatus();
  return engine_.operators().evaluate(op, arguments.operands(), arguments.steering(), arguments.numbers(), out);
}

absl::Status OperatorService::pick(const v1::PickOpeningRequest& request, v1::PickOpeningResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::FoundScene found, scenes_.find(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const blobtree::dvec3 point, read_vector("point", request.point()));
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::OpeningPick pick,
                            scenes::pick_opening(found, request.node(), point, engine_));
  response.set_theta(pick.theta);
  response.set_alpha(pick.alpha);
  response.set_f1(pick.f1);
  response.set_f2(pick.f2);
  return absl::OkStatus();
}

}  // namespace isofield::rpc
