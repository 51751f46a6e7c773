#include "integration/peer.h"

#include <absl/strings/str_cat.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include <cstring>

#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

template <class T>
void append(const v1::Tensor& tensor, v1::Tensor::DType dtype, std::vector<T>& out) {
  EXPECT_EQ(tensor.dtype(), dtype);
  std::uint64_t count = 1;
  for (const std::uint64_t n : tensor.shape()) count *= n;
  ASSERT_EQ(tensor.data().size(), count * sizeof(T));
  const std::size_t before = out.size();
  out.resize(before + count);
  if (count > 0) std::memcpy(out.data() + before, tensor.data().data(), tensor.data().size());
}

template <class T>
v1::Tensor tensor_of(std::span<const T> xyz, v1::Tensor::DType dtype) {
  v1::Tensor tensor;
  tensor.set_dtype(dtype);
  tensor.add_shape(xyz.size() / 3);
  tensor.add_shape(3);
  tensor.set_data(xyz.data(), xyz.size_bytes());
  return tensor;
}

}  // namespace

Peer::Peer(const std::string& address, Messages messages) {
  grpc::ChannelArguments arguments;
  if (messages == Messages::kOfAnySize) {
    arguments.SetMaxReceiveMessageSize(-1);
    arguments.SetMaxSendMessageSize(-1);
  }
  // Without this option all channels of the process to one address share a connection.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  channel_ = grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  scenes_ = v1::SceneService::NewStub(channel_);
  fields_ = v1::FieldService::NewStub(channel_);
  meshes_ = v1::MeshService::NewStub(channel_);
  infos_ = v1::InfoService::NewStub(channel_);
  operators_ = v1::OperatorService::NewStub(channel_);
  surfaces_ = v1::SurfaceService::NewStub(channel_);
}

grpc::Status Peer::put(const std::string& name, const v1::Scene& scene, v1::SceneSummary* summary) {
  v1::PutSceneRequest request;
  request.set_name(name);
  *request.mutable_scene() = scene;
  return put(request, summary);
}

grpc::Status Peer::put(const v1::PutSceneRequest& request, v1::SceneSummary* summary) {
  LimitedContext context;
  v1::PutSceneResponse response;
  const grpc::Status status = scenes_->PutScene(&context, request, &response);
  if (summary) *summary = response.summary();
  return status;
}

grpc::Status Peer::get(const std::string& name, v1::GetSceneResponse* response) {
  LimitedContext context;
  v1::GetSceneRequest request;
  request.set_name(name);
  return scenes_->GetScene(&context, request, response);
}

grpc::Status Peer::remove(const std::string& name) {
  LimitedContext context;
  v1::DeleteSceneRequest request;
  request.set_name(name);
  v1::DeleteSceneResponse response;
  return scenes_->DeleteScene(&context, request, &response);
}

std::vector<v1::SceneSummary> Peer::list() {
  LimitedContext context;
  v1::ListScenesResponse response;
  EXPECT_TRUE(ok(scenes_->ListScenes(&context, {}, &response)));
  return {response.scenes().begin(), response.scenes().end()};
}

grpc::Status Peer::edit(const v1::EditParametersRequest& request, v1::SceneSummary* summary) {
  LimitedContext context;
  v1::EditParametersResponse response;
  const grpc::Status status = scenes_->EditParameters(&context, request, &response);
  if (summary) *summary = response.summary();
  return status;
}

v1::GetInfoResponse Peer::info() {
  LimitedContext context;
  v1::GetInfoResponse response;
  EXPECT_TRUE(ok(infos_->GetInfo(&context, {}, &response)));
  return response;
}

grpc::Status Peer::evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient,
                            std::vector<float>* out) {
  v1::EvaluateRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(gradient ? v1::VALUE_AND_GRADIENT : v1::VALUE);
  *request.mutable_points() = points_tensor(xyz);
  request.set_max_answer_bytes(~0ull);  // the channel takes any
  v1::EvaluateResponse response;
  grpc::Status status = evaluate(request, &response);
  if (!status.ok()) return status;
  EXPECT_EQ(response.result().shape_size(), 2);
  EXPECT_EQ(response.result().shape(0), xyz.size() / 3);
  EXPECT_EQ(response.result().shape(1), gradient ? 4u : 1u);
  if (out) *out = floats_of(response.result());
  return status;
}

grpc::Status Peer::evaluate(const v1::EvaluateRequest& request, v1::EvaluateResponse* response) {
  LimitedContext context;
  return fields_->Evaluate(&context, request, response);
}

grpc::Status Peer::evaluate_stream(const std::vector<v1::EvaluateStreamRequest>& requests,
                                   std::vector<v1::EvaluateResponse>* responses) {
  LimitedContext context;
  const auto stream = fields_->EvaluateStream(&context);
  for (const v1::EvaluateStreamRequest& request : requests) {
    if (!stream->Write(request)) break;
  }
  stream->WritesDone();
  v1::EvaluateResponse response;
  while (stream->Read(&response)) {
    if (responses) responses->push_back(response);
  }
  return stream->Finish();
}

grpc::Status Peer::evaluate_grid(const v1::EvaluateGridRequest& request, std::vector<float>* out,
                                 std::size_t* messages) {
  LimitedContext context;
  const auto stream = fields_->EvaluateGrid(&context, request);
  v1::EvaluateGridResponse response;
  std::uint64_t points = 0;
  while (stream->Read(&response)) {
    const auto& shape = response.result().shape();
    EXPECT_EQ(shape.size(), 4);
    const std::uint64_t row = response.first_layer() * request.counts(1) + response.first_row();
    EXPECT_EQ(row * request.counts(0) + response.first_column(), points) << "parts follow one another";
    EXPECT_TRUE(shape[2] == request.counts(0) || shape[0] * shape[1] == 1) << "a part of a row";
    EXPECT_TRUE(shape[1] == request.counts(1) || shape[0] == 1) << "a part of a layer";
    points += shape[0] * shape[1] * shape[2];
    if (out) append(response.result(), v1::Tensor::FLOAT32, *out);
    if (messages) ++*messages;
  }
  const grpc::Status status = stream->Finish();
  if (status.ok()) {
    EXPECT_EQ(points, request.counts(0) * request.counts(1) * request.counts(2));
  }
  return status;
}

grpc::Status Peer::mesh(const v1::MeshRequest& request, ReceivedMesh* mesh) {
  LimitedContext context;
  const auto stream = meshes_->Mesh(&context, request);
  v1::MeshResponse response;
  bool has_summary = false;
  while (stream->Read(&response)) {
    EXPECT_FALSE(has_summary) << "the summary comes last";
    if (response.has_progress()) {
      mesh->progress.push_back(response.progress().fraction());
      mesh->waited_for_kernels |= response.progress().stage() == v1::MeshProgress::COMPILING_KERNELS;
    }
    if (response.has_summary()) mesh->summary = response.summary();
    has_summary = has_summary || response.has_summary();
    if (!response.has_part()) continue;
    const v1::MeshPart& part = response.part();
    if (part.has_positions()) append(part.positions(), v1::Tensor::FLOAT32, mesh->positions);
    if (part.has_normals()) append(part.normals(), v1::Tensor::FLOAT32, mesh->normals);
    if (part.has_triangles()) append(part.triangles(), v1::Tensor::UINT32, mesh->triangles);
  }
  const grpc::Status status = stream->Finish();
  if (status.ok()) {
    EXPECT_TRUE(has_summary);
    EXPECT_EQ(mesh->positions.size(), 3 * mesh->summary.vertices());
    EXPECT_EQ(mesh->triangles.size(), 3 * mesh->summary.triangles());
  }
  return status;
}

ReceivedMesh Peer::mesh(const v1::MeshRequest& request) {
  ReceivedMesh received;
  EXPECT_TRUE(ok(mesh(request, &received)));
  return received;
}

v1::SceneRef named(const std::string& name) {
  v1::SceneRef ref;
  ref.set_name(name);
  return ref;
}

v1::SceneRef inlined(const v1::Scene& scene) {
  v1::SceneRef ref;
  *ref.mutable_inline_() = scene;
  return ref;
}

v1::Tensor points_tensor(std::span<const float> xyz) {
  return tensor_of(xyz, v1::Tensor::FLOAT32);
}
v1::Tensor points_tensor(std::span<const double> xyz) {
  return tensor_of(xyz, v1::Tensor::FLOAT64);
}

std::vector<float> floats_of(const v1::Tensor& tensor) {
  std::vector<float> floats;
  append(tensor, v1::Tensor::FLOAT32, floats);
  return floats;
}

v1::MeshRequest mesh_request(const v1::SceneRef& scene, double cell_size) {
  v1::MeshRequest request;
  *request.mutable_scene() = scene;
  request.set_cell_size(cell_size);
  return request;
}

testing::AssertionResult ok(const grpc::Status& status) {
  if (status.ok()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "status " << status.error_code() << ": " << status.error_message();
}

void expect_refused(const grpc::Status& status, grpc::StatusCode code, const std::vector<std::string>& parts) {
  EXPECT_EQ(status.error_code(), code) << status.error_message();
  for (const std::string& part : parts) {
    EXPECT_NE(status.error_message().find(part), std::string::npos)
        << "'" << part << "' in: " << status.error_message();
  }
}

void expect_serving(const std::string& address) {
  Peer other(address);
  std::vector<float> values;
  const v1::Scene ball = test_support::scene_of_nodes(R"({"sphere": {"radius": 1, "range": 1}})");
  const std::vector<float> points{1, 0, 0, 0, 9, 0};
  ASSERT_TRUE(ok(other.evaluate(inlined(ball), points, false, &values)));
  EXPECT_NEAR(values.at(0), 0.5, 1e-6);
  EXPECT_EQ(values.at(1), 0);
}

}  // namespace isofield::integration_test
