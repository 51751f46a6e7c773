// Implements FieldService of the contract: Evaluate, EvaluateStream and EvaluateGrid, which evaluate fields at points.
#pragma once

#include <functional>
#include <memory>

#include "engine/engine.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "rpc/call_log.h"
#include "rpc/evaluate_arguments.h"
#include "rpc/handler.h"
#include "rpc/limits.h"
#include "rpc/shared_regions.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// EvaluateGrid is handled here. EvaluateCalls and EvaluateStreams take the other two calls from gRPC, and use the
// public functions. Thread-safe.
class FieldService final : public v1::FieldService::WithRawMethod_Evaluate<
                               v1::FieldService::WithRawMethod_EvaluateStream<v1::FieldService::Service>> {
 public:
  // `batches` admits points of Evaluate and counts those of EvaluateStream, and `grids` admits grids. `regions` is null
  // if no memory is shared.
  FieldService(const scenes::SceneSource& scenes, engine::Engine& engine, const Limits& limits, Admission& batches,
               Admission& grids, const SharedRegions* regions, const CallLog& log)
      : scenes_(scenes),
        engine_(engine),
        limits_(limits),
        batches_(batches),
        grids_(grids),
        regions_(regions),
        log_(log) {}

  // Receives the status and, if it is OK, the bytes of an EvaluateResponse.
  using Answer = std::function<void(const absl::Status&, const grpc::ByteBuffer& response)>;
  // Reads `incoming` into `request`, and evaluates it. Calls `done` once, on this thread or another; all arguments must
  // live until then.
  void evaluate(const grpc::ServerContext& context, grpc::ByteBuffer& incoming, v1::EvaluateRequest& request,
                Answer done);
  // Returns the batch, without points, that the first message of a stream describes for all its messages.
  absl::StatusOr<engine::PointBatch> begin(const grpc::ServerContext& context,
                                           const v1::EvaluateStreamRequest& first) const;
  // Reads the points of one message of a stream.
  absl::StatusOr<MessagePoints> points_of(const v1::EvaluateStreamRequest& request,
                                          const engine::ResultLayout& layout) const;
  engine::Engine& engine() { return engine_; }
  const Limits& limits() const { return limits_; }
  Admission& batches() { return batches_; }
  const CallLog& log() const { return log_; }

  grpc::Status EvaluateGrid(grpc::ServerContext* context, const v1::EvaluateGridRequest* request,
                            grpc::ServerWriter<v1::EvaluateGridResponse>* writer) override {
    return serve(*context, grids_, [&](Call& call) { return evaluate_grid(call, *request, *writer); });
  }

 private:
  struct Evaluation;
  absl::StatusOr<std::shared_ptr<Evaluation>> read(const grpc::ServerContext& context, grpc::ByteBuffer& incoming,
                                                   v1::EvaluateRequest& request) const;
  // Makes a batch that lacks its points, and notes the request's scene for the log.
  template <class Request>
  absl::StatusOr<engine::PointBatch> batch_of(const grpc::ServerContext& context, const Request& request) const;
  absl::Status evaluate_grid(Call& call, const v1::EvaluateGridRequest& request,
                             grpc::ServerWriter<v1::EvaluateGridResponse>& writer);

  const scenes::SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
  Admission& batches_;
  Admission& grids_;
  const SharedRegions* const regions_;
  const CallLog& log_;
};

}  // namespace isofield::rpc
