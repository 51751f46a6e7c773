#include <absl/strings/str_cat.h>

#include <algorithm>

#include "client_impl.h"
#include "tensor.h"

namespace isofield {

absl::StatusOr<v1::OperatorSummary> Client::put_operator(const std::string& name, v1::Operator message) {
  v1::PutOperatorRequest request;
  request.set_name(name);
  *request.mutable_operator_() = std::move(message);
  v1::PutOperatorResponse response;
  const auto status = impl_->call(
      [&](grpc::ClientContext* context) { return impl_->operators->PutOperator(context, request, &response); });
  if (!status.ok()) return status;
  return std::move(*response.mutable_summary());
}

absl::StatusOr<v1::GetOperatorResponse> Client::get_operator(const std::string& name) {
  v1::GetOperatorRequest request;
  request.set_name(name);
  request.set_max_answer_bytes(kMaxAnswerBytes);
  v1::GetOperatorResponse response;
  const auto status = impl_->retry([&] {
    return impl_->call(
        [&](grpc::ClientContext* context) { return impl_->operators->GetOperator(context, request, &response); });
  });
  if (!status.ok()) return status;
  return response;
}

absl::StatusOr<std::vector<v1::OperatorSummary>> Client::list_operators() {
  std::vector<v1::OperatorSummary> all;
  v1::ListOperatorsRequest request;
  v1::ListOperatorsResponse response;
  do {
    const auto status = impl_->retry([&] {
      return impl_->call(
          [&](grpc::ClientContext* context) { return impl_->operators->ListOperators(context, request, &response); });
    });
    if (!status.ok()) return status;
    all.insert(all.end(), response.operators().begin(), response.operators().end());
    if (!all.empty()) request.set_after(all.back().name());
  } while (response.has_more() && !response.operators().empty());
  return all;
}

absl::Status Client::delete_operator(const std::string& name) {
  v1::DeleteOperatorRequest request;
  request.set_name(name);
  v1::DeleteOperatorResponse response;
  return impl_->call(
      [&](grpc::ClientContext* context) { return impl_->operators->DeleteOperator(context, request, &response); });
}

absl::StatusOr<OperatorValues> Client::evaluate_operator(v1::EvaluateOperatorRequest request,
                                                         std::span<const float> arguments) {
  const std::size_t width = std::max(request.columns_size(), 1);
  if (arguments.size() % width != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(arguments.size(), " numbers; expected a multiple of the ", request.columns_size(), " columns"));
  }
  const std::size_t rows = arguments.size() / width;
  request.set_max_answer_bytes(kMaxAnswerBytes);
  OperatorValues all;
  // One message goes even without rows, since the server checks the operator and the columns.
  for (std::size_t first = 0; first == 0 || first < rows; first += kChunkPoints) {
    const std::size_t count = std::min(kChunkPoints, rows - first);
    set_floats(arguments.subspan(first * width, count * width), width, *request.mutable_arguments());
    v1::EvaluateOperatorResponse response;
    absl::Status status = impl_->retry([&] {
      return impl_->call([&](grpc::ClientContext* context) {
        return impl_->operators->EvaluateOperator(context, request, &response);
      });
    });
    if (!status.ok()) {
      if (first == 0) return status;
      return absl::Status(status.code(), absl::StrCat("after ", first, " rows: ", status.message()));
    }
    const std::size_t before = all.values.size();
    const auto columns = static_cast<std::size_t>(response.columns_size());
    if (status = append_floats(response.results(), columns, all.values); !status.ok()) return status;
    if (columns == 0 || all.values.size() - before != count * columns) {
      return absl::InternalError(absl::StrCat("the server answered ", all.values.size() - before, " numbers in ",
                                              columns, " columns to ", count, " rows"));
    }
    all.columns.assign(response.columns().begin(), response.columns().end());
  }
  return all;
}

absl::StatusOr<v1::PickOpeningResponse> Client::pick_opening(const v1::SceneRef& scene, const std::string& node,
                                                             const std::array<double, 3>& point) {
  v1::PickOpeningRequest request;
  *request.mutable_scene() = scene;
  request.set_node(node);
  for (const double x : point) request.add_point(x);
  v1::PickOpeningResponse response;
  const auto status = impl_->retry([&] {
    return impl_->call(
        [&](grpc::ClientContext* context) { return impl_->operators->PickOpening(context, request, &response); });
  });
  if (!status.ok()) return status;
  return response;
}

}  // namespace isofield
