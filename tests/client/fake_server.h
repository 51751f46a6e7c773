// A server inside the test process that answers the whole contract with known values, for tests of the client.
#pragma once

#include <grpcpp/server.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "isofield/v1/field_service.grpc.pb.h"
#include "isofield/v1/info_service.grpc.pb.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "isofield/v1/operator_service.grpc.pb.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "isofield/v1/surface_service.grpc.pb.h"

namespace isofield {

// Answers every request by one field: f(p) = x + 2y + 3z with gradient (1, 2, 3), whatever the scene is. Its mesh is a
// torus, but rays meet the plane f = iso. A scene reference by name must be in the catalog. Every operator is the sum
// of its columns, and every opening is theta = alpha / 4.
class FakeServer {
 public:
  // Listens at `address`, "unix:PATH" or "HOST:PORT".
  explicit FakeServer(const std::string& address);
  ~FakeServer();

  // These members say how requests fail, and what the server has seen of them.
  std::atomic<int> unavailable_for = 0;  // this many reads and writes are answered by UNAVAILABLE
  std::atomic<int> busy_for = 0;         // this many evaluations of one message are refused, to be sent again at once
  std::atomic<int> reads = 0;
  std::atomic<int> writes = 0;
  std::atomic<int> stream_messages = 0;
  std::atomic<std::size_t> largest_chunk = 0;               // points
  std::atomic<int> fail_stream_after = -1;                  // chunks
  std::atomic<std::size_t> answer_rows = ~std::size_t{0};   // the most rows in a message of a streamed evaluation
  std::atomic<std::size_t> page_entries = ~std::size_t{0};  // the most entries in a page of a list
  std::atomic<std::uint64_t> max_answer_bytes = 0;          // as the last request states it
  std::atomic<bool> short_answer = false;
  std::atomic<bool> garbled_scene = false;   // the parts of a scene do not join to one
  std::atomic<bool> misplaced_rows = false;  // the parts of a grid say that they are first rows
  std::atomic<bool> endless_mesh = false;
  std::atomic<bool> mesh_cancelled = false;
  std::atomic<bool> wrong_summary = false;
  std::atomic<bool> too_thin = false;  // the summary says that the mesh's cells are too coarse
  std::string mesh_unit;               // the unit in the summary
  // The corner and its wedge that a mesh with creases has, if the request asks for creases.
  std::vector<std::uint32_t> crease_corner = {0, 1};

 private:
  class Scenes;
  class Fields;
  class Meshes;
  class Infos;
  class Operators;
  class Surfaces;

  // These count a request, and refuse it where `unavailable_for` says so.
  grpc::Status admit_read();
  grpc::Status admit_write();
  grpc::Status admit();
  grpc::Status find(const v1::SceneRef& reference);

  std::mutex mutex_;
  std::map<std::string, v1::GetSceneResponse> catalog_;
  std::map<std::string, v1::GetOperatorResponse> operator_catalog_;
  std::uint64_t version_ = 0;
  std::unique_ptr<v1::SceneService::Service> scenes_;
  std::unique_ptr<v1::FieldService::Service> fields_;
  std::unique_ptr<v1::MeshService::Service> meshes_;
  std::unique_ptr<v1::InfoService::Service> infos_;
  std::unique_ptr<v1::OperatorService::Service> operators_;
  std::unique_ptr<v1::SurfaceService::Service> surfaces_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace isofield
