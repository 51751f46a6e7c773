#include "fake_server.h"

#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_builder.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "test_support.h"

namespace isofield {
namespace {

grpc::Status not_found(const std::string& name) {
  return grpc::Status(grpc::StatusCode::NOT_FOUND, "no scene \"" + name + "\"");
}

void fill(const void* data, std::size_t bytes, v1::Tensor::DType type, std::initializer_list<std::uint64_t> shape,
          v1::Tensor& tensor) {
  tensor.set_dtype(type);
  for (const std::uint64_t dimension : shape) tensor.add_shape(dimension);
  tensor.set_data(data, bytes);
}

// Fills a page with the entries of a catalog that come after a name.
template <class Response, class Map, class Add>
void list(const Map& catalog, const std::string& after, std::size_t most, Response& response, const Add& add) {
  for (auto it = catalog.upper_bound(after); it != catalog.end(); ++it) {
    if (most-- == 0) return response.set_has_more(true);
    add(it->second.summary());
  }
}

std::vector<float> floats(const v1::Tensor& tensor) {
  std::vector<float> numbers(tensor.data().size() / sizeof(float));
  if (!numbers.empty()) std::memcpy(numbers.data(), tensor.data().data(), tensor.data().size());
  return numbers;
}

float f(const float* p) {
  return p[0] + 2 * p[1] + 3 * p[2];
}

void evaluate(const v1::Tensor& points, bool gradient, v1::Tensor& result) {
  const std::vector<float> xyz = floats(points);
  std::vector<float> out;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    out.push_back(f(&xyz[i]));
    if (gradient) out.insert(out.end(), {1, 2, 3});
  }
  result.Clear();
  fill(out.data(), out.size() * sizeof(float), v1::Tensor::FLOAT32, {xyz.size() / 3, gradient ? 4u : 1u}, result);
}

}  // namespace

class FakeServer::Scenes : public v1::SceneService::Service {
 public:
  explicit Scenes(FakeServer& owner) : owner_(owner) {}

  grpc::Status PutScene(grpc::ServerContext*, const v1::PutSceneRequest* request,
                        v1::PutSceneResponse* response) override {
    if (auto status = owner_.admit_write(); !status.ok()) return status;
    if (request->scene().nodes_size() == 0) {
      return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "scene: no nodes; expected at least 1");
    }
    const std::lock_guard lock(owner_.mutex_);
    auto& stored = owner_.catalog_[request->name()];
    *stored.mutable_scene() = request->scene();
    stored.mutable_summary()->set_name(request->name());
    stored.mutable_summary()->set_version(++owner_.version_);
    stored.mutable_summary()->set_nodes(static_cast<std::uint64_t>(request->scene().nodes_size()));
    *response->mutable_summary() = stored.summary();
    return grpc::Status::OK;
  }

  grpc::Status GetScene(grpc::ServerContext*, const v1::GetSceneRequest* request,
                        v1::GetSceneResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    const auto found = owner_.catalog_.find(request->name());
    if (found == owner_.catalog_.end()) return not_found(request->name());
    *response = found->second;
    return grpc::Status::OK;
  }

  grpc::Status GetSceneParts(grpc::ServerContext* context, const v1::GetSceneRequest* request,
                             grpc::ServerWriter<v1::ScenePart>* writer) override {
    v1::GetSceneResponse whole;
    if (auto status = GetScene(context, request, &whole); !status.ok()) return status;
    const std::string bytes = owner_.garbled_scene ? "no scene" : whole.scene().SerializeAsString();
    const std::size_t half = bytes.size() / 2;
    v1::ScenePart part;
    *part.mutable_summary() = whole.summary();
    part.set_data(bytes.substr(0, half));
    writer->Write(part);
    part.clear_summary();
    part.set_data(bytes.substr(half));
    writer->Write(part);
    return grpc::Status::OK;
  }

  grpc::Status ListScenes(grpc::ServerContext*, const v1::ListScenesRequest* request,
                          v1::ListScenesResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    list(owner_.catalog_, request->after(), owner_.page_entries, *response,
         [&](const v1::SceneSummary& summary) { *response->add_scenes() = summary; });
    return grpc::Status::OK;
  }

  grpc::Status DeleteScene(grpc::ServerContext*, const v1::DeleteSceneRequest* request,
                           v1::DeleteSceneResponse*) override {
    if (auto status = owner_.admit_write(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    return owner_.catalog_.erase(request->name()) ? grpc::Status::OK : not_found(request->name());
  }

  grpc::Status EditParameters(grpc::ServerContext*, const v1::EditParametersRequest* request,
                              v1::EditParametersResponse* response) override {
    if (auto status = owner_.admit_write(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    const auto found = owner_.catalog_.find(request->name());
    if (found == owner_.catalog_.end()) return not_found(request->name());
    if (request->edits_size() != 1 || request->edits(0).node() != "ball" || request->edits(0).field() != "center" ||
        request->edits(0).values_size() != 3) {
      return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "expected one edit of ball.center");
    }
    found->second.mutable_summary()->set_version(++owner_.version_);
    *response->mutable_summary() = found->second.summary();
    return grpc::Status::OK;
  }

 private:
  FakeServer& owner_;
};

class FakeServer::Fields : public v1::FieldService::Service {
 public:
  explicit Fields(FakeServer& owner) : owner_(owner) {}

  grpc::Status Evaluate(grpc::ServerContext* context, const v1::EvaluateRequest* request,
                        v1::EvaluateResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    if (owner_.busy_for > 0) {
      --owner_.busy_for;
      context->AddTrailingMetadata("grpc-retry-pushback-ms", "1");
      return grpc::Status(grpc::StatusCode::RESOURCE_EXHAUSTED, "too many wait");
    }
    if (auto status = owner_.find(request->scene()); !status.ok()) return status;
    evaluate(request->points(), request->quantity() == v1::VALUE_AND_GRADIENT, *response->mutable_result());
    if (owner_.short_answer) response->mutable_result()->mutable_data()->pop_back();
    return grpc::Status::OK;
  }

  grpc::Status EvaluateStream(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::EvaluateResponse, v1::EvaluateStreamRequest>* stream) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    v1::EvaluateStreamRequest request;
    v1::EvaluateResponse response;
    bool gradient = false;
    for (int message = 0; stream->Read(&request); ++message) {
      ++owner_.stream_messages;
      if (message == 0) {
        if (auto status = owner_.find(request.scene()); !status.ok()) return status;
        gradient = request.quantity() == v1::VALUE_AND_GRADIENT;
        owner_.max_answer_bytes = request.max_answer_bytes();
      } else if (request.has_scene()) {
        return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "scene: first message only");
      }
      if (message == owner_.fail_stream_after) return grpc::Status(grpc::StatusCode::RESOURCE_EXHAUSTED, "too much");
      if (!request.has_points()) continue;
      owner_.largest_chunk = std::max<std::size_t>(owner_.largest_chunk, request.points().shape(0));
      const std::size_t rows = request.points().shape(0);
      std::size_t first = 0;
      do {
        const std::size_t count = std::min<std::size_t>(owner_.answer_rows, rows - first);
        v1::Tensor part = request.points();
        part.set_shape(0, count);
        part.set_data(part.data().substr(12 * first, 12 * count));
        evaluate(part, gradient, *response.mutable_result());
        stream->Write(response);
        first += count;
      } while (first < rows);
    }
    return grpc::Status::OK;
  }

  grpc::Status EvaluateGrid(grpc::ServerContext*, const v1::EvaluateGridRequest* request,
                            grpc::ServerWriter<v1::EvaluateGridResponse>* writer) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    owner_.max_answer_bytes = request->max_answer_bytes();
    // The answer has the first layer whole, the others row by row, and the last row point by point.
    const std::uint64_t nx = request->counts(0), ny = request->counts(1), nz = request->counts(2);
    const auto value = [&](std::uint64_t i, std::uint64_t j, std::uint64_t k) {
      return static_cast<float>(request->origin(0) + request->spacing(0) * static_cast<double>(i) +
                                2 * (request->origin(1) + request->spacing(1) * static_cast<double>(j)) +
                                3 * (request->origin(2) + request->spacing(2) * static_cast<double>(k)));
    };
    for (std::uint64_t at = 0; at < nx * ny * nz;) {
      const std::uint64_t i = at % nx, j = at / nx % ny, k = at / (nx * ny);
      const std::uint64_t rows = k == 0 ? ny : 1, columns = k + 1 == nz && j + 1 == ny ? 1 : nx;
      std::vector<float> part;
      for (std::uint64_t n = 0; n < rows * columns; ++n) part.push_back(value(i + n % nx, j + n / nx, k));
      v1::EvaluateGridResponse response;
      response.set_first_layer(k);
      response.set_first_row(owner_.misplaced_rows ? 0 : j);
      response.set_first_column(i);
      fill(part.data(), part.size() * sizeof(float), v1::Tensor::FLOAT32, {1, rows, columns, 1},
           *response.mutable_result());
      writer->Write(response);
      at += rows * columns;
    }
    return grpc::Status::OK;
  }

 private:
  FakeServer& owner_;
};

class FakeServer::Meshes : public v1::MeshService::Service {
 public:
  explicit Meshes(FakeServer& owner) : owner_(owner) {}

  grpc::Status Mesh(grpc::ServerContext* context, const v1::MeshRequest* request,
                    grpc::ServerWriter<v1::MeshResponse>* writer) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    if (auto status = owner_.find(request->scene()); !status.ok()) return status;
    if (request->iso() > 1 && request->bounds_min().empty()) {
      return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "iso: expected with stated bounds");
    }
    v1::MeshResponse response;
    for (int step = 0; step < 4 || owner_.endless_mesh; ++step) {
      response.mutable_progress()->set_fraction(std::min(0.9, 0.25 * step));
      writer->Write(response);
      if (context->IsCancelled()) {
        owner_.mesh_cancelled = true;
        return grpc::Status(grpc::StatusCode::CANCELLED, "cancelled");
      }
      if (owner_.endless_mesh) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const auto mesh = torus_mesh(64, 32, 1.0f, 0.4f);
    *response.mutable_summary() = mesh.summary;
    v1::MeshSummary& summary = *response.mutable_summary();
    summary.set_unit(owner_.mesh_unit);
    summary.set_bodies(owner_.too_thin ? 3 : 1);
    summary.set_voids(0);
    if (request->largest_body()) summary.set_dropped_bodies(2);
    if (owner_.too_thin) {
      summary.set_cell_size(12.5);
      summary.mutable_too_thin()->set_node("n7");
      summary.mutable_too_thin()->set_thickness(20);
      summary.mutable_too_thin()->set_cell_size(11.547);
      summary.mutable_too_thin()->set_primitives(1);
    }
    if (owner_.wrong_summary) response.mutable_summary()->set_vertices(mesh.vertex_count() + 1);
    writer->Write(response);
    // The mesh comes in parts: halves of the vertices, then all triangles.
    const std::size_t half = mesh.positions.size() / 2;
    for (const std::size_t start : {std::size_t{0}, half}) {
      auto* part = response.mutable_part();
      part->Clear();
      fill(&mesh.positions[start], half * sizeof(float), v1::Tensor::FLOAT32, {half / 3, 3},
           *part->mutable_positions());
      if (!request->omit_normals()) {
        fill(&mesh.normals[start], half * sizeof(float), v1::Tensor::FLOAT32, {half / 3, 3}, *part->mutable_normals());
      }
      writer->Write(response);
    }
    auto* part = response.mutable_part();
    part->Clear();
    fill(mesh.triangles.data(), mesh.triangles.size() * 4, v1::Tensor::UINT32, {mesh.triangle_count(), 3},
         *part->mutable_triangles());
    writer->Write(response);
    if (request->crease_normals()) {
      // The first vertex of the first triangle has two wedges.
      const std::array<std::uint32_t, 2> vertices = {mesh.triangles[0], mesh.triangles[0]};
      const std::array<float, 6> normals = {1, 0, 0, 0, 1, 0};
      auto* creases = response.mutable_creases();
      fill(vertices.data(), sizeof(vertices), v1::Tensor::UINT32, {2, 1}, *creases->mutable_vertices());
      fill(normals.data(), sizeof(normals), v1::Tensor::FLOAT32, {2, 3}, *creases->mutable_normals());
      fill(owner_.crease_corner.data(), 8, v1::Tensor::UINT32, {1, 2}, *creases->mutable_corners());
      writer->Write(response);
    }
    return grpc::Status::OK;
  }

 private:
  FakeServer& owner_;
};

class FakeServer::Infos : public v1::InfoService::Service {
 public:
  explicit Infos(FakeServer& owner) : owner_(owner) {}

  grpc::Status GetInfo(grpc::ServerContext*, const v1::GetInfoRequest*, v1::GetInfoResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    response->set_version("0.0.0-fake");
    response->mutable_device()->set_name("Fake GPU");
    v1::TuningNumber& number = *response->mutable_device()->add_profile();
    number.set_name("slab_bricks");
    number.set_value(16'384);
    number.set_unit("bricks");
    number.set_meaning("bricks of a mesh in one submission");
    return grpc::Status::OK;
  }

 private:
  FakeServer& owner_;
};

class FakeServer::Operators : public v1::OperatorService::Service {
 public:
  explicit Operators(FakeServer& owner) : owner_(owner) {}

  grpc::Status PutOperator(grpc::ServerContext*, const v1::PutOperatorRequest* request,
                           v1::PutOperatorResponse* response) override {
    if (auto status = owner_.admit_write(); !status.ok()) return status;
    if (request->operator_().kind_case() == v1::Operator::KIND_NOT_SET) {
      return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "kind = (absent)");
    }
    const std::lock_guard lock(owner_.mutex_);
    auto& stored = owner_.operator_catalog_[request->name()];
    *stored.mutable_operator_() = request->operator_();
    stored.mutable_summary()->set_name(request->name());
    stored.mutable_summary()->set_version(++owner_.version_);
    *response->mutable_summary() = stored.summary();
    return grpc::Status::OK;
  }

  grpc::Status GetOperator(grpc::ServerContext*, const v1::GetOperatorRequest* request,
                           v1::GetOperatorResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    const auto found = owner_.operator_catalog_.find(request->name());
    if (found == owner_.operator_catalog_.end()) {
      if (request->name() != "ricci") return no_operator(request->name());
      response->mutable_operator_()->mutable_ricci();
      return grpc::Status::OK;
    }
    *response = found->second;
    return grpc::Status::OK;
  }

  grpc::Status ListOperators(grpc::ServerContext*, const v1::ListOperatorsRequest* request,
                             v1::ListOperatorsResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    if (request->after().empty()) response->add_operators()->set_name("gradient");
    list(owner_.operator_catalog_, request->after(), owner_.page_entries, *response,
         [&](const v1::OperatorSummary& summary) { *response->add_operators() = summary; });
    return grpc::Status::OK;
  }

  grpc::Status DeleteOperator(grpc::ServerContext*, const v1::DeleteOperatorRequest* request,
                              v1::DeleteOperatorResponse*) override {
    if (auto status = owner_.admit_write(); !status.ok()) return status;
    const std::lock_guard lock(owner_.mutex_);
    return owner_.operator_catalog_.erase(request->name()) ? grpc::Status::OK : no_operator(request->name());
  }

  grpc::Status EvaluateOperator(grpc::ServerContext*, const v1::EvaluateOperatorRequest* request,
                                v1::EvaluateOperatorResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::size_t columns = request->columns_size(), rows = request->arguments().shape(0);
    owner_.largest_chunk = std::max<std::size_t>(owner_.largest_chunk, rows);
    std::vector<float> in(rows * columns), out;
    if (!in.empty()) std::memcpy(in.data(), request->arguments().data().data(), in.size() * sizeof(float));
    for (std::size_t row = 0; row < rows; ++row) {
      float g = 0;
      for (std::size_t i = 0; i < columns; ++i) {
        if (in[row * columns + i] < 0 && request->columns(static_cast<int>(i))[0] == 'f') {
          return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "arguments[" + std::to_string(row) + "] < 0");
        }
        g += in[row * columns + i];
      }
      out.push_back(request->has_opening() ? g / 4 : g);
      out.insert(out.end(), columns, request->has_opening() ? 0.25f : 1.0f);
    }
    response->add_columns(request->has_opening() ? "theta" : "g");
    for (const std::string& name : request->columns()) {
      response->add_columns(request->has_opening() ? "dtheta_dalpha" : "dg_d" + name);
    }
    fill(out.data(), out.size() * sizeof(float), v1::Tensor::FLOAT32, {rows, columns + 1},
         *response->mutable_results());
    if (owner_.short_answer) response->mutable_results()->mutable_data()->pop_back();
    return grpc::Status::OK;
  }

  grpc::Status PickOpening(grpc::ServerContext*, const v1::PickOpeningRequest* request,
                           v1::PickOpeningResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    if (auto status = owner_.find(request->scene()); !status.ok()) return status;
    if (request->node() != "top") return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "no such node");
    response->set_theta(request->point(0));
    response->set_alpha(request->point(1));
    response->set_f1(request->point(2));
    return grpc::Status::OK;
  }

 private:
  static grpc::Status no_operator(const std::string& name) {
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "no operator \"" + name + "\"");
  }

  FakeServer& owner_;
};

class FakeServer::Surfaces : public v1::SurfaceService::Service {
 public:
  explicit Surfaces(FakeServer& owner) : owner_(owner) {}

  grpc::Status CastRays(grpc::ServerContext*, const v1::CastRaysRequest* request,
                        v1::CastRaysResponse* response) override {
    if (auto status = owner_.admit_read(); !status.ok()) return status;
    const std::vector<float> origins = floats(request->origins()), directions = floats(request->directions());
    std::vector<float> distances, positions, normals;
    std::vector<std::uint32_t> nodes;
    for (std::size_t i = 0; i + 2 < origins.size(); i += 3) {
      const float* const o = &origins[i];
      const float* const d = &directions[i];
      const float along = d[0] + 2 * d[1] + 3 * d[2];
      const float distance = (static_cast<float>(request->has_iso() ? request->iso() : 0.5) - f(o)) / along;
      const bool hits = along != 0 && distance >= 0;
      distances.push_back(hits ? distance : std::numeric_limits<float>::infinity());
      nodes.push_back(hits ? 0 : 0xFFFFFFFF);
      for (int axis = 0; axis < 3; ++axis) {
        positions.push_back(hits ? o[axis] + distance * d[axis] : 0);
        normals.push_back(hits ? -static_cast<float>(axis + 1) / std::sqrt(14.0f) : 0);
      }
    }
    const std::size_t n = nodes.size();
    const std::string inside(n, '\0');
    fill(distances.data(), 4 * n, v1::Tensor::FLOAT32, {n, 1}, *response->mutable_distances());
    fill(positions.data(), 12 * n, v1::Tensor::FLOAT32, {n, 3}, *response->mutable_positions());
    fill(normals.data(), 12 * n, v1::Tensor::FLOAT32, {n, 3}, *response->mutable_normals());
    fill(nodes.data(), 4 * n, v1::Tensor::UINT32, {n, 1}, *response->mutable_nodes());
    fill(inside.data(), n, v1::Tensor::UINT8, {n, 1}, *response->mutable_inside());
    response->add_names("a \"plane\", x");
    return grpc::Status::OK;
  }

 private:
  FakeServer& owner_;
};

grpc::Status FakeServer::admit_read() {
  ++reads;
  return admit();
}

grpc::Status FakeServer::admit_write() {
  ++writes;
  return admit();
}

grpc::Status FakeServer::admit() {
  if (unavailable_for > 0) {
    --unavailable_for;
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "shutting down");
  }
  return grpc::Status::OK;
}

grpc::Status FakeServer::find(const v1::SceneRef& reference) {
  if (reference.has_inline_()) return grpc::Status::OK;
  const std::lock_guard lock(mutex_);
  return catalog_.count(reference.name()) ? grpc::Status::OK : not_found(reference.name());
}

FakeServer::FakeServer(const std::string& address)
    : scenes_(std::make_unique<Scenes>(*this)),
      fields_(std::make_unique<Fields>(*this)),
      meshes_(std::make_unique<Meshes>(*this)),
      infos_(std::make_unique<Infos>(*this)),
      operators_(std::make_unique<Operators>(*this)),
      surfaces_(std::make_unique<Surfaces>(*this)) {
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address, grpc::InsecureServerCredentials());
  builder.RegisterService(scenes_.get());
  builder.RegisterService(fields_.get());
  builder.RegisterService(meshes_.get());
  builder.RegisterService(infos_.get());
  builder.RegisterService(operators_.get());
  builder.RegisterService(surfaces_.get());
  builder.SetMaxReceiveMessageSize(64 << 20);
  server_ = builder.BuildAndStart();
}

FakeServer::~FakeServer() {
  server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
}

}  // namespace isofield
