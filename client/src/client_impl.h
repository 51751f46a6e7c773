// The private part of Client: the stubs of the gRPC services, and how requests are sent and tried again.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "errors.h"
#include "isofield/client.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "isofield/v1/info_service.grpc.pb.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "isofield/v1/operator_service.grpc.pb.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "isofield/v1/surface_service.grpc.pb.h"
#include "shared_memory.h"

namespace isofield {

// The coordinates of a chunk of points, shape [n, 3]. `xyz` is a view into an array of the caller, or into `kept`.
struct Chunk {
  std::vector<float> kept;
  std::span<const float> xyz;
};
// A function that fills the next chunk. It leaves the chunk empty where there are no more points.
using ChunkSource = std::function<absl::Status(Chunk& chunk)>;

// The largest message, in bytes, that the channel receives. Requests state it to the server as max_answer_bytes.
inline constexpr int kMaxAnswerBytes = 64 << 20;

struct Client::Impl {
  std::string address;
  ClientOptions options;
  std::unique_ptr<v1::SceneService::Stub> scenes;
  std::unique_ptr<v1::OperatorService::Stub> operators;
  std::unique_ptr<v1::FieldService::Stub> fields;
  std::unique_ptr<v1::MeshService::Stub> meshes;
  std::unique_ptr<v1::SurfaceService::Stub> surfaces;
  std::unique_ptr<v1::InfoService::Stub> infos;
  SharedMemoryPool shared_memory;

  // Evaluates a batch, as one message or as a stream, and hands the results to `sink` in their order. Calls `restart`
  // first, and again before a stream that is sent once more, since the results before it are then void.
  absl::Status evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                        const std::function<void()>& restart, const ResultSink& sink);
  // Evaluates a batch that travels in one message.
  absl::Status evaluate_message(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                                const ResultSink& sink);
  // Evaluates any number of points as one stream of chunks, and tries this once.
  absl::Status stream(const v1::SceneRef& scene, bool gradient, const ChunkSource& source, const ResultSink& sink);
  // Returns memory for one evaluation. Where it returns null, the evaluation sends its arrays through the connection
  // instead.
  std::unique_ptr<SharedMemory> take_shared_memory(std::size_t bytes);

  static void set_timeout(grpc::ClientContext& context, std::optional<std::chrono::milliseconds> timeout) {
    if (timeout) context.set_deadline(std::chrono::system_clock::now() + *timeout);
  }

  // Tries a request that only reads, and tries it again while the server is UNAVAILABLE. `request` makes one attempt
  // and returns its absl::Status.
  template <typename Request>
  absl::Status retry(const Request& request) const {
    auto pause = options.backoff;
    for (int attempt = 1;; ++attempt) {
      absl::Status status = request();
      if (!absl::IsUnavailable(status) || attempt >= options.attempts) return status;
      std::this_thread::sleep_for(pause);
      pause *= 2;
    }
  }

  // Calls a method that has one answer. `method` takes a grpc::ClientContext* and returns a grpc::Status. It is called
  // again where the server has refused the request before any work and says when to come back.
  template <typename Method>
  absl::Status call(const Method& method) const {
    for (int attempt = 1;; ++attempt) {
      grpc::ClientContext context;
      set_timeout(context, options.unary_timeout);
      const grpc::Status status = method(&context);
      const auto pause = status.ok() ? std::nullopt : retry_after(context);
      if (!pause || attempt >= options.attempts) return from_grpc(status, address);
      std::this_thread::sleep_for(*pause);
    }
  }
};

}  // namespace isofield
