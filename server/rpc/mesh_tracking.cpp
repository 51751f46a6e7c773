#include "rpc/mesh_tracking.h"

#include <absl/strings/str_cat.h>

#include "base/quoted.h"
#include "base/status_macros.h"
#include "rpc/answer_limit.h"
#include "rpc/parameter_edits.h"
#include "rpc/status.h"
#include "rpc/tensor.h"
#include "rpc/unreadable_requests.h"

namespace isofield::rpc {

absl::Status MeshTracking::run() {
  grpc::ByteBuffer incoming;
  v1::TrackMeshRequest request;
  while (stream_.Read(&incoming)) {
    ISOFIELD_RETURN_IF_ERROR(parse_request(incoming, request));
    if (tracker_) {
      ISOFIELD_RETURN_IF_ERROR(follow(request));
    } else if (request.message_case() == v1::TrackMeshRequest::kBegin) {
      ISOFIELD_RETURN_IF_ERROR(begin(request.begin()));
    } else {
      return absl::InvalidArgumentError("the first message of the stream: expected begin, which says what to mesh");
    }
  }
  return absl::OkStatus();
}

absl::Status MeshTracking::begin(const v1::MeshRequest& request) {
  if (request.scene().ref_case() != v1::SceneRef::kName) {
    return absl::InvalidArgumentError("begin.scene: expected the name of a scene that the server keeps");
  }
  ISOFIELD_RETURN_IF_ERROR(check_as_made(request));
  scene_ = request.scene();
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(scene_));
  ISOFIELD_ASSIGN_OR_RETURN(request_, read_mesh_request(request, *leased.scene, engine_.mesher(), limits_,
                                                        [&] { return context_.IsCancelled(); }));
  tracker_.emplace(engine_.mesher(), request_);
  return answer(leased);
}

absl::Status MeshTracking::follow(const v1::TrackMeshRequest& request) {
  switch (request.message_case()) {
    case v1::TrackMeshRequest::kEdit: {
      const v1::EditParametersRequest& edit = request.edit();
      if (!edit.name().empty() && edit.name() != scene_.name()) {
        return absl::InvalidArgumentError(absl::StrCat("edit.name = ", base::quoted(edit.name()),
                                                       ": expected none, or the name ", base::quoted(scene_.name()),
                                                       " of the scene that this stream follows"));
      }
      ISOFIELD_ASSIGN_OR_RETURN(const scenes::StoredScene stored,
                                editor_.edit(scene_.name(), read_edits(edit.edits()), edit.expected_version()));
      return answer({stored.lease, stored.entry.version, stored.entry.scene});
    }
    case v1::TrackMeshRequest::kRefresh: {
      ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(scene_));
      return answer(leased);
    }
    default:
      return absl::InvalidArgumentError("expected edit or refresh: begin is the stream's first message alone");
  }
}

absl::Status MeshTracking::answer(const scenes::LeasedScene& leased) {
  MeshTotals totals;
  const Admission::Ticket ticket = admission_.count(estimated_cells(leased.scene->tape(), request_));
  ISOFIELD_ASSIGN_OR_RETURN(const engine::MeshTracker::Update update,
                            tracker_->update(leased.scene, {.cancelled = [&] { return context_.IsCancelled(); }}));
  ++version_;
  // A message is held back until the next one begins, since the last one of an update is marked as the last.
  v1::MeshUpdate next;
  next.set_is_whole(update.is_whole);
  const auto write_next = [&] {
    next.set_scene_version(leased.version);
    return write(std::exchange(next, {}));
  };
  std::vector<std::uint32_t> removed;
  for (const auto& brick : update.removed) removed.insert(removed.end(), brick.begin(), brick.end());
  const auto add_removed = [&](std::span<const std::uint32_t> rows) {
    if (next.has_removed()) {
      ISOFIELD_RETURN_IF_ERROR(write_next());
    }
    set_rows(rows, 3, *next.mutable_removed());
    return absl::OkStatus();
  };
  const auto add_bricks = [&](v1::MeshBricks bricks) {
    if (next.has_bricks()) {
      ISOFIELD_RETURN_IF_ERROR(write_next());
    }
    *next.mutable_bricks() = std::move(bricks);
    return absl::OkStatus();
  };
  ISOFIELD_RETURN_IF_ERROR(in_parts(std::span<const std::uint32_t>(removed), 3, add_removed));
  for (const engine::MeshCells& cells : update.changed) {
    totals.cells += cells.cells;
    ISOFIELD_RETURN_IF_ERROR(write_bricks(cells, add_bricks));
  }
  totals.vertices = tracker_->vertices();
  totals.triangles = tracker_->triangles();
  next.set_scene_version(leased.version);
  next.set_is_last(true);
  fill_summary(totals, request_, leased, *next.mutable_summary());
  return write(std::move(next));
}

absl::Status MeshTracking::write(v1::MeshUpdate update) {
  update.set_version(version_);
  v1::TrackMeshResponse response;
  *response.mutable_update() = std::move(update);
  if (stream_.Write(response)) return absl::OkStatus();
  return client_gone();
}

}  // namespace isofield::rpc
