#include "rpc/evaluate_arguments.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <functional>

#include "base/status_macros.h"

namespace isofield::rpc {
namespace {

absl::StatusOr<int> read_priority(v1::Priority priority) {
  switch (priority) {
    case v1::PRIORITY_LOW:
      return -1;
    case v1::PRIORITY_UNSPECIFIED:
    case v1::PRIORITY_NORMAL:
      return 0;
    case v1::PRIORITY_HIGH:
      return 1;
    default:
      return absl::InvalidArgumentError(absl::StrCat("priority = ", static_cast<int>(priority),
                                                     ": expected PRIORITY_LOW, PRIORITY_NORMAL or PRIORITY_HIGH"));
  }
}

absl::StatusOr<SharedBytes> read_shared_result(const v1::SharedTensor& tensor, std::uint64_t rows,
                                               const engine::ResultLayout& layout, const SharedRegions& regions) {
  const std::uint64_t columns = layout.numbers();
  if (tensor.dtype() != v1::Tensor::FLOAT32) {
    return absl::InvalidArgumentError(
        absl::StrCat("shared_result.dtype = ", static_cast<int>(tensor.dtype()), ": expected FLOAT32"));
  }
  if (tensor.shape_size() != 2 || tensor.shape(0) != rows || tensor.shape(1) != columns) {
    return absl::InvalidArgumentError(absl::StrCat("shared_result.shape = [", absl::StrJoin(tensor.shape(), ", "),
                                                   "]: expected [", rows, ", ", columns, "], rows of ",
                                                   layout.names()));
  }
  return regions.find(tensor, rows * columns, sizeof(float), "shared_result");
}

bool overlap(std::span<const std::byte> a, std::span<const std::byte> b) {
  const std::less<> before;
  return before(a.data(), b.data() + b.size()) && before(b.data(), a.data() + a.size());
}

}  // namespace

absl::StatusOr<engine::ResultLayout> read_layout(v1::Quantity quantity) {
  switch (quantity) {
    case v1::QUANTITY_UNSPECIFIED:
    case v1::VALUE:
      return engine::ResultLayout::kValue;
    case v1::VALUE_AND_GRADIENT:
      return engine::ResultLayout::kValueAndGradient;
    default:
      return absl::InvalidArgumentError(
          absl::StrCat("quantity = ", static_cast<int>(quantity), ": expected VALUE or VALUE_AND_GRADIENT"));
  }
}

absl::StatusOr<engine::PointBatch> read_batch(const grpc::ServerContext& context, const scenes::SceneSource& scenes,
                                              const v1::SceneRef& scene, v1::Quantity quantity, v1::Priority priority) {
  engine::PointBatch batch;
  ISOFIELD_ASSIGN_OR_RETURN(batch.layout, read_layout(quantity));
  ISOFIELD_ASSIGN_OR_RETURN(batch.priority, read_priority(priority));
  ISOFIELD_ASSIGN_OR_RETURN(scenes::LeasedScene leased, scenes.lease(scene));
  batch.scene = std::move(leased.scene);
  batch.deadline = context.deadline();
  batch.cancelled = [&context] { return context.IsCancelled(); };
  return batch;
}

absl::StatusOr<MessagePoints> read_points(const PointFields& fields, const engine::ResultLayout& layout,
                                          const Limits& limits, const SharedRegions* regions) {
  if (!regions && (fields.shared_points || fields.shared_result)) {
    return absl::FailedPreconditionError(
        "the server shares no memory: start isofieldd with --shared-memory, or send the points");
  }
  if (fields.points && fields.shared_points) {
    return absl::InvalidArgumentError("points and shared_points are both stated: expected one of them");
  }
  MessagePoints message;
  if (fields.shared_points) {
    ISOFIELD_ASSIGN_OR_RETURN(message.points,
                              PointArray::read(*fields.shared_points, *regions, limits.max_points_per_message));
  } else {
    const v1::Tensor& points = fields.points ? *fields.points : v1::Tensor::default_instance();
    ISOFIELD_ASSIGN_OR_RETURN(message.points, PointArray::read(points, limits.max_points_per_message));
  }
  if (!fields.shared_result) return message;
  ISOFIELD_ASSIGN_OR_RETURN(message.result,
                            read_shared_result(*fields.shared_result, message.points.size(), layout, *regions));
  if (!fields.shared_points) return message;
  const std::uint64_t number = fields.shared_points->dtype() == v1::Tensor::FLOAT32 ? 4 : 8;
  ISOFIELD_ASSIGN_OR_RETURN(const SharedBytes points,
                            regions->find(*fields.shared_points, 3 * message.points.size(), number, "shared_points"));
  if (overlap(points.bytes, message.result->bytes)) {
    return absl::InvalidArgumentError(absl::StrCat("shared_result, from ", fields.shared_result->offset(),
                                                   " on, overlaps shared_points, from ", fields.shared_points->offset(),
                                                   " on: expected places apart"));
  }
  return message;
}

}  // namespace isofield::rpc
