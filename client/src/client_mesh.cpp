#include <absl/strings/str_cat.h>

#include <algorithm>

#include "client_impl.h"
#include "tensor.h"

namespace isofield {
namespace {

absl::Status append_part(const v1::MeshPart& part, Mesh& mesh) {
  absl::Status status;
  if (part.has_positions()) status.Update(append_floats(part.positions(), 3, mesh.positions));
  if (part.has_normals()) status.Update(append_floats(part.normals(), 3, mesh.normals));
  if (part.has_triangles()) status.Update(append_indices(part.triangles(), 3, mesh.triangles));
  return status;
}

absl::Status append_creases(const v1::MeshCreases& part, Mesh::Creases& creases) {
  absl::Status status;
  if (part.has_vertices()) status.Update(append_indices(part.vertices(), 1, creases.vertices));
  if (part.has_normals()) status.Update(append_floats(part.normals(), 3, creases.normals));
  if (part.has_corners()) status.Update(append_indices(part.corners(), 2, creases.corners));
  return status;
}

// Checks the creases. INTERNAL: the wedges do not fit the mesh.
absl::Status check_creases(const Mesh& mesh) {
  const auto& [vertices, normals, corners] = mesh.creases;
  const std::size_t wedges = vertices.size();
  bool fits = normals.size() == 3 * wedges && (wedges == 0 || !mesh.normals.empty());
  for (const std::uint32_t vertex : vertices) fits &= vertex < mesh.vertex_count();
  for (std::size_t i = 0; fits && i < corners.size(); i += 2) {
    fits = corners[i] < mesh.triangles.size() && corners[i + 1] < wedges &&
           mesh.triangles[corners[i]] == vertices[corners[i + 1]];
  }
  return fits ? absl::OkStatus() : absl::InternalError("the server sent creases that do not fit the mesh");
}

// Checks a whole mesh. INTERNAL: the arrays do not hold what the summary announced.
absl::Status check(const Mesh& mesh) {
  const auto& summary = mesh.summary;
  const bool normals_fit = mesh.normals.empty() || mesh.normals.size() == mesh.positions.size();
  if (mesh.vertex_count() != summary.vertices() || mesh.triangle_count() != summary.triangles() || !normals_fit) {
    return absl::InternalError(absl::StrCat("the server announced ", summary.vertices(), " vertices and ",
                                            summary.triangles(), " triangles, but sent ", mesh.vertex_count(),
                                            " positions, ", mesh.normals.size() / 3, " normals and ",
                                            mesh.triangle_count(), " triangles"));
  }
  const auto largest = std::max_element(mesh.triangles.begin(), mesh.triangles.end());
  if (largest != mesh.triangles.end() && *largest >= mesh.vertex_count()) {
    return absl::InternalError(
        absl::StrCat("the server sent a triangle that names vertex ", *largest, " of ", mesh.vertex_count()));
  }
  return check_creases(mesh);
}

absl::Status check(const MeshedBricks& mesh) {
  const auto& [bricks, summary] = mesh;
  if (bricks.vertex_count() == summary.vertices() && bricks.triangle_count() == summary.triangles()) {
    return absl::OkStatus();
  }
  return absl::InternalError(absl::StrCat("the server announced ", summary.vertices(), " vertices and ",
                                          summary.triangles(), " triangles, but sent bricks of ", bricks.vertex_count(),
                                          " and ", bricks.triangle_count()));
}

// Reads a stream to its end. It has messages of progress, a summary and messages of another kind, which go to `take`.
template <class Response, class Take>
absl::Status read_mesh(grpc::ClientContext& context, grpc::ClientReader<Response>& stream,
                       const Client::Progress& progress, v1::MeshSummary& summary, const std::string& address,
                       const Take& take) {
  Response response;
  absl::Status status;
  while (status.ok() && stream.Read(&response)) {
    switch (response.message_case()) {
      case Response::kProgress:
        if (progress && !progress(response.progress())) status = absl::CancelledError("mesh cancelled");
        break;
      case Response::kSummary:
        summary = response.summary();
        break;
      case Response::MESSAGE_NOT_SET:
        break;
      default:
        status = take(response);
    }
  }
  if (!status.ok()) context.TryCancel();
  const grpc::Status finished = stream.Finish();
  return status.ok() ? from_grpc(finished, address) : status;
}

}  // namespace

absl::StatusOr<Mesh> Client::mesh(const v1::MeshRequest& request, const Progress& progress) {
  Mesh mesh;
  const auto attempt = [&]() -> absl::Status {
    mesh = Mesh();
    grpc::ClientContext context;
    Impl::set_timeout(context, impl_->options.stream_timeout);
    const auto stream = impl_->meshes->Mesh(&context, request);
    const auto status =
        read_mesh(context, *stream, progress, mesh.summary, impl_->address, [&](const v1::MeshResponse& response) {
          return response.has_creases() ? append_creases(response.creases(), mesh.creases)
                                        : append_part(response.part(), mesh);
        });
    return status.ok() ? check(mesh) : status;
  };
  if (auto status = impl_->retry(attempt); !status.ok()) return status;
  return mesh;
}

absl::StatusOr<MeshedBricks> Client::mesh_bricks(const v1::MeshBricksRequest& request, const Progress& progress) {
  MeshedBricks mesh;
  const auto attempt = [&]() -> absl::Status {
    mesh = MeshedBricks();
    grpc::ClientContext context;
    Impl::set_timeout(context, impl_->options.stream_timeout);
    const auto stream = impl_->meshes->GetMeshBricks(&context, request);
    const auto status =
        read_mesh(context, *stream, progress, mesh.summary, impl_->address,
                  [&](const v1::MeshBricksResponse& response) { return mesh.bricks.apply(response.bricks()); });
    return status.ok() ? check(mesh) : status;
  };
  if (auto status = impl_->retry(attempt); !status.ok()) return status;
  return mesh;
}

absl::StatusOr<v1::MeasureResponse> Client::measure(const v1::MeshRequest& request) {
  v1::MeasureResponse response;
  const auto status = impl_->retry([&] {
    grpc::ClientContext context;
    Impl::set_timeout(context, impl_->options.stream_timeout);
    return from_grpc(impl_->meshes->Measure(&context, request, &response), impl_->address);
  });
  if (!status.ok()) return status;
  return response;
}

}  // namespace isofield
