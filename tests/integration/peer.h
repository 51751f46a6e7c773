// A client made of the generated stubs alone, and helpers for tests that use it.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "isofield/v1/field_service.grpc.pb.h"
#include "isofield/v1/info_service.grpc.pb.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "isofield/v1/operator_service.grpc.pb.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "isofield/v1/surface_service.grpc.pb.h"

namespace isofield::integration_test {

// The context of a call that ends with DEADLINE_EXCEEDED after five minutes, so that a fault fails the test that would
// hang otherwise.
class LimitedContext : public grpc::ClientContext {
 public:
  LimitedContext() { set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(5)); }
};

// A mesh as it came over the wire.
struct ReceivedMesh {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> triangles;
  v1::MeshSummary summary;
  std::vector<double> progress;
  bool waited_for_kernels = false;
};

// A client with a connection of its own to one daemon. Every method is one request. Any number of threads may call
// them.
class Peer {
 public:
  // The largest message that the channel receives: any size, or gRPC's default of 4 MiB.
  enum class Messages { kOfAnySize, kByDefault };
  explicit Peer(const std::string& address, Messages messages = Messages::kOfAnySize);

  grpc::Status put(const std::string& name, const v1::Scene& scene, v1::SceneSummary* summary = nullptr);
  grpc::Status put(const v1::PutSceneRequest& request, v1::SceneSummary* summary = nullptr);
  grpc::Status get(const std::string& name, v1::GetSceneResponse* response);
  grpc::Status remove(const std::string& name);
  std::vector<v1::SceneSummary> list();
  grpc::Status edit(const v1::EditParametersRequest& request, v1::SceneSummary* summary = nullptr);
  v1::GetInfoResponse info();

  grpc::Status evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient, std::vector<float>* out);
  grpc::Status evaluate(const v1::EvaluateRequest& request, v1::EvaluateResponse* response);
  // Writes all messages of the stream before it reads the answers, so it suits only short streams.
  grpc::Status evaluate_stream(const std::vector<v1::EvaluateStreamRequest>& requests,
                               std::vector<v1::EvaluateResponse>* responses);
  // Joins the answers, and checks their order and shape.
  grpc::Status evaluate_grid(const v1::EvaluateGridRequest& request, std::vector<float>* out,
                             std::size_t* messages = nullptr);
  grpc::Status mesh(const v1::MeshRequest& request, ReceivedMesh* mesh);
  // Returns the mesh. If there is none, the test fails.
  ReceivedMesh mesh(const v1::MeshRequest& request);

  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  v1::FieldService::Stub& fields() { return *fields_; }
  v1::MeshService::Stub& meshes() { return *meshes_; }
  v1::OperatorService::Stub& operators() { return *operators_; }
  v1::SceneService::Stub& scenes() { return *scenes_; }
  v1::SurfaceService::Stub& surfaces() { return *surfaces_; }

 private:
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::SceneService::Stub> scenes_;
  std::unique_ptr<v1::FieldService::Stub> fields_;
  std::unique_ptr<v1::MeshService::Stub> meshes_;
  std::unique_ptr<v1::InfoService::Stub> infos_;
  std::unique_ptr<v1::OperatorService::Stub> operators_;
  std::unique_ptr<v1::SurfaceService::Stub> surfaces_;
};

v1::SceneRef named(const std::string& name);
v1::SceneRef inlined(const v1::Scene& scene);
v1::Tensor points_tensor(std::span<const float> xyz);
v1::Tensor points_tensor(std::span<const double> xyz);
std::vector<float> floats_of(const v1::Tensor& tensor);
v1::MeshRequest mesh_request(const v1::SceneRef& scene, double cell_size);

// EXPECT_TRUE(ok(...)) prints what went wrong.
testing::AssertionResult ok(const grpc::Status& status);
// Checks the status code, and that the text names all of these parts.
void expect_refused(const grpc::Status& status, grpc::StatusCode code, const std::vector<std::string>& parts);
// Checks that the daemon is alive and serves another client.
void expect_serving(const std::string& address);

}  // namespace isofield::integration_test
