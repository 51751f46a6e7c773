// Serves EvaluateGrid: it reads the lattice of a request, and evaluates and sends its points a few layers at a time.
#pragma once

#include <absl/status/statusor.h>
#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/points/field_evaluator.h"
#include "isofield/v1/field_service.pb.h"
#include "rpc/handler.h"
#include "rpc/limits.h"

namespace isofield::rpc {

// Reads the lattice of a request; each of its cells stands for one point. INVALID_ARGUMENT, RESOURCE_EXHAUSTED: see
// field_service.proto.
absl::StatusOr<blobtree::Lattice> read_lattice(const v1::EvaluateGridRequest& request, const Limits& limits);

std::uint64_t points_of_lattice(const blobtree::Lattice& lattice);

// Serves one call, on one thread. Everything that it refers to must outlive it.
class GridEvaluation {
 public:
  using Writer = grpc::ServerWriter<v1::EvaluateGridResponse>;

  // A message holds at most `most` points.
  GridEvaluation(engine::FieldEvaluator& fields, const engine::ResidentScene& scene, const blobtree::Lattice& lattice,
                 engine::ResultLayout layout, std::uint64_t most, const Call& call, Writer& writer);

  // CANCELLED: the client is gone. Other errors are those of the evaluator.
  absl::Status run();

 private:
  // Evaluates layers from `first` on into one message, and sends it.
  absl::Status send_at_once(std::uint32_t first, std::uint32_t layers);
  // Evaluates layers from `first` on, and sends them in several messages.
  absl::Status send_in_parts(std::uint32_t first, std::uint32_t layers);

  engine::FieldEvaluator& fields_;
  const engine::ResidentScene& scene_;
  const blobtree::Lattice& lattice_;
  const engine::ResultLayout layout_;
  const std::uint32_t width_;  // numbers for each point
  const std::uint64_t layer_;  // points in a layer
  const std::uint64_t most_;
  const std::function<bool()> cancelled_;
  Writer& writer_;
  v1::EvaluateGridResponse response_;
  std::vector<float> several_;  // results of layers that take more than one message
};

}  // namespace isofield::rpc
