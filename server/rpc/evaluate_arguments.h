// What Evaluate and EvaluateStream read from their messages.
#pragma once

#include <absl/status/statusor.h>
#include <grpcpp/server_context.h>

#include <optional>

#include "engine/engine.h"
#include "isofield/v1/field_service.pb.h"
#include "rpc/limits.h"
#include "rpc/shared_regions.h"
#include "rpc/tensor.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

absl::StatusOr<engine::ResultLayout> read_layout(v1::Quantity quantity);

// All but the points of a call, or of a stream of them. `context` must outlive the batch.
absl::StatusOr<engine::PointBatch> read_batch(const grpc::ServerContext& context, const scenes::SceneSource& scenes,
                                              const v1::SceneRef& scene, v1::Quantity quantity, v1::Priority priority);

// The fields of a message that say where points are and results go; null: absent.
struct PointFields {
  const v1::Tensor* points = nullptr;
  const v1::SharedTensor* shared_points = nullptr;
  const v1::SharedTensor* shared_result = nullptr;

  template <class Request>
  explicit PointFields(const Request& r)
      : points(r.has_points() ? &r.points() : nullptr),
        shared_points(r.has_shared_points() ? &r.shared_points() : nullptr),
        shared_result(r.has_shared_result() ? &r.shared_result() : nullptr) {}
  bool has_points() const { return points || shared_points; }
};

struct MessagePoints {
  PointArray points;
  // Where the request names one.
  std::optional<SharedBytes> result;

  std::span<float> shared_numbers() const {
    return {reinterpret_cast<float*>(result->bytes.data()), result->bytes.size() / sizeof(float)};
  }
};

// `regions`: null where no memory is shared. What the fields refer to must outlive the result.
absl::StatusOr<MessagePoints> read_points(const PointFields& fields, const engine::ResultLayout& layout,
                                          const Limits& limits, const SharedRegions* regions);

}  // namespace isofield::rpc
