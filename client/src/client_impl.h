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

// [n, 3] coordinates, the caller's own or `kept`.
struct Chunk {
  std::vector<float> kept;
  std::span<const float> xyz;
};
// The next one; empty: there are no more.
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

  // Hands a batch's results to `sink` in their order; begins anew, with `restart`, where it is sent once more.
  absl::Status evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                        const std::function<void()>& restart, const ResultSink& sink);
  absl::Status evaluate_message(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                                const ResultSink& sink);
  // Any number of points, in chunks.
  absl::Status stream(const v1::SceneRef& scene, bool gradient, const ChunkSource& source, const ResultSink& sink);
  // For one evaluation; null: it takes the wire.
  std::unique_ptr<SharedMemory> take_shared_memory(std::size_t bytes);

  static void set_timeout(grpc::ClientContext& context, std::optional<std::chrono::milliseconds> timeout) {
    if (timeout) context.set_deadline(std::chrono::system_clock::now() + *timeout);
  }

  // `request`: absl::Status(), one attempt at something that only reads; tried again while UNAVAILABLE.
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

  // `method`: grpc::Status(grpc::ClientContext*), one message each way. Tried again where the server has refused it
  // unseen and says when to come back.
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
