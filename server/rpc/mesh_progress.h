// Tells the client of a mesh request how much of the work is done.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>

#include "engine/mesh/mesh_request.h"
#include "isofield/v1/mesh_service.pb.h"
#include "rpc/handler.h"

namespace isofield::rpc {

// Serves one request, on one thread. `Response` is a message with a field of type MeshProgress.
template <class Response>
class MeshProgressWriter {
 public:
  explicit MeshProgressWriter(grpc::ServerWriter<Response>& writer) : writer_(writer) {}

  // Sends the fraction if the last message is at least kEvery old or was about another stage. Failures are ignored.
  void at(double fraction) {
    fraction_ = fraction;
    const Clock::time_point now = Clock::now();
    if (now - last_ < kEvery && stage_ == v1::MeshProgress::MESHING) return;
    last_ = now;
    send(v1::MeshProgress::MESHING);
  }
  void compiling() {
    if (stage_ != v1::MeshProgress::COMPILING_KERNELS) send(v1::MeshProgress::COMPILING_KERNELS);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kEvery = std::chrono::milliseconds(100);

  void send(v1::MeshProgress::Stage stage) {
    stage_ = stage;
    Response response;
    response.mutable_progress()->set_fraction(fraction_);
    response.mutable_progress()->set_stage(stage);
    writer_.Write(response);
  }

  grpc::ServerWriter<Response>& writer_;
  Clock::time_point last_ = Clock::now();
  double fraction_ = 0;
  v1::MeshProgress::Stage stage_ = v1::MeshProgress::MESHING;
};

// Returns callbacks that write progress to the client and tell whether it still waits. `writer` must outlive them.
template <class Response>
engine::MeshCallbacks mesh_callbacks(const Call& call, grpc::ServerWriter<Response>& writer) {
  const auto progress = std::make_shared<MeshProgressWriter<Response>>(writer);
  return {
      .progress = [progress](double fraction) { progress->at(fraction); },
      .compiling = [progress] { progress->compiling(); },
      .cancelled = call.cancelled(),
  };
}

}  // namespace isofield::rpc
