// Reads the arguments of Evaluate and EvaluateStream from their messages.
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

// INVALID_ARGUMENT: `quantity` is none of the enumeration.
absl::StatusOr<engine::ResultLayout> read_layout(v1::Quantity quantity);

// Returns the batch of a call or of a stream without its points and its place for results; it holds a lease of the
// scene. `context` must outlive the batch. INVALID_ARGUMENT: a value is not in its enumeration. Other errors are those
// of SceneSource::lease.
absl::StatusOr<engine::PointBatch> read_batch(const grpc::ServerContext& context, const scenes::SceneSource& scenes,
                                              const v1::SceneRef& scene, v1::Quantity quantity, v1::Priority priority);

// The fields of a message that say where its points are and where results go. Absent fields are null.
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

// The points of a message, and the place for their results.
struct MessagePoints {
  PointArray points;
  // The place in shared memory, if the request names one; else results go into the answer.
  std::optional<SharedBytes> result;

  // Returns that place as numbers. It requires `result`.
  std::span<float> shared_numbers() const {
    return {reinterpret_cast<float*>(result->bytes.data()), result->bytes.size() / sizeof(float)};
  }
};

// `regions` is null if no memory is shared. The messages that `fields` refers to must outlive the result.
// INVALID_ARGUMENT, RESOURCE_EXHAUSTED, NOT_FOUND: an array is refused. FAILED_PRECONDITION: the server shares no
// memory.
absl::StatusOr<MessagePoints> read_points(const PointFields& fields, const engine::ResultLayout& layout,
                                          const Limits& limits, const SharedRegions* regions);

}  // namespace isofield::rpc
