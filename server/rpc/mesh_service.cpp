#include "rpc/mesh_service.h"

#include <absl/strings/str_cat.h>
#include <grpcpp/support/method_handler.h>

#include <algorithm>

#include "base/guarded.h"
#include "base/status_macros.h"
#include "engine/simplify/mesh_measure.h"
#include "engine/simplify/mesh_simplifier.h"
#include "rpc/geometry_arguments.h"
#include "rpc/mesh_progress.h"
#include "rpc/mesh_tracking.h"
#include "rpc/mesh_writer.h"
#include "rpc/open_stream.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

// Meshing makes this part of the progress if the mesh is simplified afterwards.
constexpr double kMeshingPart = 0.4;

// The changes to the mesh that a request asks for: leaving out bodies or voids, and simplifying. They need the whole
// mesh first.
struct Refinement {
  engine::ShellFilter shells;
  std::optional<double> simplification_error;

  static absl::StatusOr<Refinement> read(const v1::MeshRequest& request) {
    ISOFIELD_ASSIGN_OR_RETURN(const std::optional<double> error, read_simplification_error(request));
    return Refinement{read_shell_filter(request), error};
  }
  bool is_none() const { return shells.keeps_all() && !simplification_error; }
};

// Makes the whole mesh and refines it. Counts in `totals` what it has and what was dropped.
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

// Reads which bricks a request asks for; nothing means all of them.
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

MeshService::MeshService(const scenes::SceneSource& scenes, scenes::SceneEditor& editor, engine::Engine& engine,
                         const Limits& limits, Admission& admission)
    : scenes_(scenes), editor_(editor), engine_(engine), limits_(limits), admission_(admission) {
  const auto* service = v1::TrackMeshRequest::descriptor()->file()->FindServiceByName("MeshService");
  const int method = service->FindMethodByName("TrackMesh")->index();
  MarkMethodStreamed(method,
                     new grpc::internal::BidiStreamingHandler<MeshService, grpc::ByteBuffer, v1::TrackMeshResponse>(
                         [](MeshService* service, grpc::ServerContext* context, TrackMeshStream* stream) {
                           const auto track = [&] { return service->track(*context, *stream); };
                           return finish(*context, base::guarded(track));
                         },
                         this));
}

absl::Status MeshService::mesh(Call& call, const v1::MeshRequest& request,
                               grpc::ServerWriter<v1::MeshResponse>& writer) {
  MeshTotals totals;
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const Refinement refinement, Refinement::read(request));
  const engine::MeshCallbacks callbacks = mesh_callbacks(call, writer);
  ISOFIELD_ASSIGN_OR_RETURN(const engine::MeshRequest r,
                            read_mesh_request(request, *leased.scene, engine_.mesher(), limits_, callbacks.cancelled));
  ISOFIELD_RETURN_IF_ERROR(call.admit(estimated_cells(leased.scene->tape(), r)));
  ISOFIELD_ASSIGN_OR_RETURN(const bool with_creases, read_crease_normals(request));
  MeshWriter out(writer, with_creases);
  if (refinement.is_none()) {
    const auto deliver = [&](const engine::MeshCells& cells) {
      totals.add(cells);
      return out.write(cells);
    };
    ISOFIELD_RETURN_IF_ERROR(engine_.mesher().cells(*leased.scene, r, callbacks, deliver, &totals.shells));
  } else {
    ISOFIELD_ASSIGN_OR_RETURN(engine::Mesh whole,
                              make_mesh(engine_.mesher(), *leased.scene, r, refinement, callbacks, totals));
    ISOFIELD_RETURN_IF_ERROR(out.write(std::move(whole)));
  }
  ISOFIELD_RETURN_IF_ERROR(out.write_creases());
  v1::MeshResponse response;
  fill_summary(totals, r, leased, *response.mutable_summary());
  return send(writer, response);
}

absl::Status MeshService::get_bricks(Call& call, const v1::MeshBricksRequest& request,
                                     grpc::ServerWriter<v1::MeshBricksResponse>& writer) {
  MeshTotals totals;
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.mesh().scene()));
  ISOFIELD_RETURN_IF_ERROR(check_as_made(request.mesh()));
  const engine::MeshCallbacks callbacks = mesh_callbacks(call, writer);
  ISOFIELD_ASSIGN_OR_RETURN(engine::MeshRequest r, read_mesh_request(request.mesh(), *leased.scene, engine_.mesher(),
                                                                     limits_, callbacks.cancelled));
  ISOFIELD_ASSIGN_OR_RETURN(r.part, read_part(request));
  ISOFIELD_RETURN_IF_ERROR(call.admit(estimated_cells(leased.scene->tape(), r)));
  const auto deliver = [&](const engine::MeshCells& cells) {
    totals.add(cells);
    return write_bricks(cells, [&](v1::MeshBricks bricks) {
      v1::MeshBricksResponse response;
      *response.mutable_bricks() = std::move(bricks);
      return send(writer, response);
    });
  };
  ISOFIELD_RETURN_IF_ERROR(engine_.mesher().cells(*leased.scene, r, callbacks, deliver, &totals.shells));
  v1::MeshBricksResponse response;
  fill_summary(totals, r, leased, *response.mutable_summary());
  return send(writer, response);
}

absl::Status MeshService::track(grpc::ServerContext& context, TrackMeshStream& stream) {
  const OpenStream open(tracked_);
  if (open.count() > limits_.max_tracked_meshes) {
    return absl::ResourceExhaustedError(absl::StrCat(
        limits_.max_tracked_meshes,
        " meshes are tracked, as many as are admitted (an eighth of --max-threads): end one, or try again"));
  }
  return MeshTracking(scenes_, editor_, engine_, limits_, admission_, context, stream).run();
}

absl::Status MeshService::measure(Call& call, const v1::MeshRequest& request, v1::MeasureResponse& response) {
  MeshTotals totals;
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const Refinement refinement, Refinement::read(request));
  const engine::MeshCallbacks callbacks{.cancelled = call.cancelled()};
  ISOFIELD_ASSIGN_OR_RETURN(engine::MeshRequest r,
                            read_mesh_request(request, *leased.scene, engine_.mesher(), limits_, callbacks.cancelled));
  ISOFIELD_RETURN_IF_ERROR(call.admit(estimated_cells(leased.scene->tape(), r)));
  r.with_normals = false;
  ISOFIELD_ASSIGN_OR_RETURN(const engine::Mesh mesh,
                            make_mesh(engine_.mesher(), *leased.scene, r, refinement, callbacks, totals));
  const engine::MeshMeasures measures = engine::measure(mesh);
  response.set_area(measures.area);
  response.set_volume(measures.volume);
  if (measures.volume > 0) set_vector(measures.centroid, *response.mutable_centroid());
  if (!measures.bounds.empty()) {
    set_vector(measures.bounds.min, *response.mutable_bounds_min());
    set_vector(measures.bounds.max, *response.mutable_bounds_max());
  }
  fill_summary(totals, r, leased, *response.mutable_summary());
  return absl::OkStatus();
}

}  // namespace isofield::rpc
