#include "rpc/mesh_service.h"

#include <absl/strings/str_cat.h>
#include <grpcpp/support/method_handler.h>

#include <algorithm>

#include "base/status_macros.h"
#include "engine/simplify/mesh_measure.h"
#include "engine/simplify/mesh_simplifier.h"
#include "rpc/answer_limit.h"
#include "rpc/geometry_arguments.h"
#include "rpc/mesh_messages.h"
#include "rpc/mesh_progress.h"
#include "rpc/mesh_tracking.h"
#include "rpc/open_stream.h"
#include "rpc/status.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

// Writes an array of rows of 3 in parts. False: the client is gone.
template <class T>
bool write_rows(grpc::ServerWriter<v1::MeshResponse>& writer, const std::vector<T>& rows,
                v1::Tensor* (v1::MeshPart::*field)()) {
  return in_parts(std::span<const T>(rows), 3, [&](std::span<const T> part) {
    v1::MeshResponse response;
    set_rows(part, 3, *(response.mutable_part()->*field)());
    return writer.Write(response);
  });
}

// The part of the progress that meshing makes, where the mesh is simplified after that.
constexpr double kMeshingPart = 0.4;

// The parts of a request that need the whole mesh.
struct Refinement {
  engine::ShellFilter shells;
  std::optional<double> simplification_error;

  static absl::StatusOr<Refinement> read(const v1::MeshRequest& request) {
    ISOFIELD_ASSIGN_OR_RETURN(const std::optional<double> error, read_simplification_error(request));
    return Refinement{read_shell_filter(request), error};
  }
  bool is_none() const { return shells.keeps_all() && !simplification_error; }
};

// The whole mesh, refined. Notes in `totals` what was dropped.
absl::StatusOr<engine::Mesh> make_mesh(engine::Mesher& mesher, const engine::ResidentScene& scene,
                                       const engine::MeshRequest& request, const Refinement& refinement,
                                       const engine::MeshCallbacks& callbacks, MeshTotals& totals) {
  engine::MeshCallbacks meshing = callbacks, simplifying = callbacks;
  if (callbacks.progress && refinement.simplification_error) {
    meshing.progress = [&](double f) { callbacks.progress(kMeshingPart * f); };
    simplifying.progress = [&](double f) { callbacks.progress(kMeshingPart + (1 - kMeshingPart) * f); };
  }
  const bool keeps_all = refinement.shells.keeps_all();
  ISOFIELD_ASSIGN_OR_RETURN(engine::Mesh mesh,
                            mesher.mesh(scene, request, meshing, keeps_all ? &totals.shells : nullptr));
  if (!keeps_all) {
    engine::KeptShells kept = engine::keep_shells(mesh, refinement.shells, request.cell_size);
    mesh = std::move(kept.mesh);
    totals.shells = kept.shells;
    totals.dropped = kept.dropped;
  }
  if (refinement.simplification_error) {
    ISOFIELD_ASSIGN_OR_RETURN(mesh, engine::simplify(mesh, *refinement.simplification_error, simplifying));
  }
  totals.add(mesh);
  return mesh;
}

// Nothing: all.
absl::StatusOr<std::optional<blobtree::BrickBox>> read_part(const v1::MeshBricksRequest& request) {
  const auto &first = request.first_brick(), &counts = request.brick_counts();
  if (first.empty() && counts.empty()) return std::nullopt;
  if (first.size() != 3 || counts.size() != 3) {
    return absl::InvalidArgumentError(absl::StrCat("first_brick and brick_counts hold ", first.size(), " and ",
                                                   counts.size(), " numbers: expected 3 each, or none"));
  }
  blobtree::BrickBox box;
  for (int i = 0; i < 3; ++i) {
    if (counts[i] == 0) {
      return absl::InvalidArgumentError(absl::StrCat("brick_counts[", i, "] = 0: expected at least 1"));
    }
    box.low[i] = first[i];
    box.high[i] = first[i] + std::min(counts[i], ~first[i]);
  }
  return box;
}

}  // namespace

grpc::Status MeshService::Mesh(grpc::ServerContext* context, const v1::MeshRequest* request,
                               grpc::ServerWriter<v1::MeshResponse>* writer) {
  MeshTotals totals;
  const absl::StatusOr<scenes::LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());
  const absl::StatusOr<Refinement> refinement = Refinement::read(*request);
  if (!refinement.ok()) return to_grpc(refinement.status());
  const engine::MeshCallbacks callbacks = mesh_callbacks(*context, *writer);
  const absl::StatusOr<engine::MeshRequest> r =
      read_mesh_request(*request, *leased->scene, engine_.mesher(), limits_, callbacks.cancelled);
  if (!r.ok()) return to_grpc(r.status());
  const auto write = [&](const auto& part, const std::vector<std::uint32_t>& triangles) {
    const bool written = write_rows(*writer, part.positions, &v1::MeshPart::mutable_positions) &&
                         write_rows(*writer, part.normals, &v1::MeshPart::mutable_normals) &&
                         write_rows(*writer, triangles, &v1::MeshPart::mutable_triangles);
    return written ? absl::OkStatus() : client_gone();
  };
  absl::Status status;
  if (refinement->is_none()) {
    engine::MeshJoiner joiner;
    const auto deliver = [&](const engine::MeshCells& cells) {
      totals.add(cells);
      return write(cells, joiner.number(cells));
    };
    status = engine_.mesher().cells(*leased->scene, *r, callbacks, deliver, &totals.shells);
  } else {
    const auto mesh = make_mesh(engine_.mesher(), *leased->scene, *r, *refinement, callbacks, totals);
    status = mesh.ok() ? write(*mesh, mesh->triangles) : mesh.status();
  }
  if (!status.ok()) return to_grpc(status);
  v1::MeshResponse response;
  fill_summary(totals, *r, *leased, *response.mutable_summary());
  return writer->Write(response) ? grpc::Status::OK : to_grpc(client_gone());
}

grpc::Status MeshService::GetMeshBricks(grpc::ServerContext* context, const v1::MeshBricksRequest* request,
                                        grpc::ServerWriter<v1::MeshBricksResponse>* writer) {
  MeshTotals totals;
  const absl::StatusOr<scenes::LeasedScene> leased = scenes_.lease(request->mesh().scene());
  if (!leased.ok()) return to_grpc(leased.status());
  if (const absl::Status status = check_as_made(request->mesh()); !status.ok()) return to_grpc(status);
  const engine::MeshCallbacks callbacks = mesh_callbacks(*context, *writer);
  absl::StatusOr<engine::MeshRequest> r =
      read_mesh_request(request->mesh(), *leased->scene, engine_.mesher(), limits_, callbacks.cancelled);
  if (!r.ok()) return to_grpc(r.status());
  auto part = read_part(*request);
  if (!part.ok()) return to_grpc(part.status());
  r->part = *part;
  const auto deliver = [&](const engine::MeshCells& cells) {
    totals.add(cells);
    const bool written = write_bricks(cells, [&](v1::MeshBricks bricks) {
      v1::MeshBricksResponse response;
      *response.mutable_bricks() = std::move(bricks);
      return writer->Write(response);
    });
    return written ? absl::OkStatus() : client_gone();
  };
  const absl::Status status = engine_.mesher().cells(*leased->scene, *r, callbacks, deliver, &totals.shells);
  if (!status.ok()) return to_grpc(status);
  v1::MeshBricksResponse response;
  fill_summary(totals, *r, *leased, *response.mutable_summary());
  return writer->Write(response) ? grpc::Status::OK : to_grpc(client_gone());
}

MeshService::MeshService(const scenes::SceneSource& scenes, scenes::SceneEditor& editor, engine::Engine& engine,
                         const Limits& limits)
    : scenes_(scenes), editor_(editor), engine_(engine), limits_(limits) {
  const auto* service = v1::TrackMeshRequest::descriptor()->file()->FindServiceByName("MeshService");
  const int method = service->FindMethodByName("TrackMesh")->index();
  MarkMethodStreamed(method, new grpc::internal::BidiStreamingHandler<MeshService, grpc::ByteBuffer,
                                                                      v1::TrackMeshResponse>(
                                 [](MeshService* service, grpc::ServerContext* context, TrackMeshStream* stream) {
                                   return service->track_mesh(*context, *stream);
                                 },
                                 this));
}

grpc::Status MeshService::track_mesh(grpc::ServerContext& context, TrackMeshStream& stream) {
  const OpenStream open(tracked_);
  if (open.count() > limits_.max_tracked_meshes) {
    return to_grpc(absl::ResourceExhaustedError(absl::StrCat(
        limits_.max_tracked_meshes,
        " meshes are tracked, as many as are admitted (an eighth of --max-threads): end one, or try again")));
  }
  return to_grpc(MeshTracking(scenes_, editor_, engine_, limits_, context, stream).run());
}

grpc::Status MeshService::Measure(grpc::ServerContext* context, const v1::MeshRequest* request,
                                  v1::MeasureResponse* response) {
  MeshTotals totals;
  const absl::StatusOr<scenes::LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());
  const absl::StatusOr<Refinement> refinement = Refinement::read(*request);
  if (!refinement.ok()) return to_grpc(refinement.status());
  const engine::MeshCallbacks callbacks{.cancelled = [&] { return context->IsCancelled(); }};
  absl::StatusOr<engine::MeshRequest> r =
      read_mesh_request(*request, *leased->scene, engine_.mesher(), limits_, callbacks.cancelled);
  if (!r.ok()) return to_grpc(r.status());
  r->with_normals = false;
  const absl::StatusOr<engine::Mesh> mesh =
      make_mesh(engine_.mesher(), *leased->scene, *r, *refinement, callbacks, totals);
  if (!mesh.ok()) return to_grpc(mesh.status());

  const engine::MeshMeasures measures = engine::measure(*mesh);
  response->set_area(measures.area);
  response->set_volume(measures.volume);
  if (measures.volume > 0) set_vector(measures.centroid, *response->mutable_centroid());
  if (!measures.bounds.empty()) {
    set_vector(measures.bounds.min, *response->mutable_bounds_min());
    set_vector(measures.bounds.max, *response->mutable_bounds_max());
  }
  fill_summary(totals, *r, *leased, *response->mutable_summary());
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
