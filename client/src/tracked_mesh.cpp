#include "isofield/tracked_mesh.h"

#include <absl/strings/str_cat.h>

#include <utility>

#include "client_impl.h"

namespace isofield {

struct TrackedMesh::Impl {
  std::string address;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::TrackMeshRequest, v1::TrackMeshResponse>> stream;
  BrickMesh bricks;
  v1::MeshSummary summary;
  MeshChanges changes;
  bool is_finished = false;
  absl::Status status;  // the error that has ended the stream

  ~Impl() {
    if (stream && !is_finished) end();
  }

  absl::StatusOr<v1::MeshSummary> ask(const v1::TrackMeshRequest& request) {
    if (!status.ok()) return status;
    // If the request cannot be written, reading says why.
    stream->Write(request);
    status = receive();
    if (!status.ok()) {
      if (!is_finished) end();
      return status;
    }
    return summary;
  }

 private:
  // Reads one answer: one or more updates.
  absl::Status receive() {
    changes = {};
    v1::TrackMeshResponse response;
    do {
      if (!stream->Read(&response)) {
        is_finished = true;
        const grpc::Status finished = stream->Finish();
        if (!finished.ok()) return from_grpc(finished, address);
        return absl::InternalError("the server ended the stream of a tracked mesh without an answer");
      }
      if (auto applied = apply(response.update()); !applied.ok()) return applied;
    } while (!response.update().is_last());
    summary = response.update().summary();
    if (bricks.vertex_count() != summary.vertices() || bricks.triangle_count() != summary.triangles()) {
      return absl::InternalError(absl::StrCat("the server announced ", summary.vertices(), " vertices and ",
                                              summary.triangles(), " triangles, but its bricks hold ",
                                              bricks.vertex_count(), " and ", bricks.triangle_count()));
    }
    return absl::OkStatus();
  }

  absl::Status apply(const v1::MeshUpdate& update) {
    const std::size_t before = bricks.brick_count();
    if (update.is_whole()) {
      bricks.clear();
      changes.is_whole = true;
    }
    absl::Status applied;
    if (update.has_removed()) applied.Update(bricks.remove(update.removed()));
    changes.bricks_removed += before - bricks.brick_count();
    if (!update.has_bricks() || !applied.ok()) return applied;
    applied = bricks.apply(update.bricks());
    if (applied.ok() && update.bricks().bricks().shape_size() > 0) {
      changes.bricks_put += update.bricks().bricks().shape(0);
    }
    return applied;
  }

  void end() {
    is_finished = true;
    context.TryCancel();
    stream->Finish();
  }
};

TrackedMesh::TrackedMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TrackedMesh::TrackedMesh(TrackedMesh&&) noexcept = default;
TrackedMesh& TrackedMesh::operator=(TrackedMesh&&) noexcept = default;
TrackedMesh::~TrackedMesh() = default;

absl::StatusOr<v1::MeshSummary> TrackedMesh::edit(const std::vector<v1::ParameterEdit>& edits,
                                                  std::uint64_t expected_version) {
  v1::TrackMeshRequest request;
  request.mutable_edit()->mutable_edits()->Add(edits.begin(), edits.end());
  request.mutable_edit()->set_expected_version(expected_version);
  return impl_->ask(request);
}

absl::StatusOr<v1::MeshSummary> TrackedMesh::refresh() {
  v1::TrackMeshRequest request;
  request.mutable_refresh();
  return impl_->ask(request);
}

void TrackedMesh::cancel() {
  impl_->context.TryCancel();
}

const BrickMesh& TrackedMesh::bricks() const {
  return impl_->bricks;
}
const v1::MeshSummary& TrackedMesh::summary() const {
  return impl_->summary;
}
const MeshChanges& TrackedMesh::changes() const {
  return impl_->changes;
}

absl::StatusOr<TrackedMesh> Client::track_mesh(const v1::MeshRequest& request) {
  v1::TrackMeshRequest begin;
  *begin.mutable_begin() = request;
  std::unique_ptr<TrackedMesh::Impl> tracked;
  const auto status = impl_->retry([&] {
    tracked = std::make_unique<TrackedMesh::Impl>();
    tracked->address = impl_->address;
    tracked->stream = impl_->meshes->TrackMesh(&tracked->context);
    return tracked->ask(begin).status();
  });
  if (!status.ok()) return status;
  return TrackedMesh(std::move(tracked));
}

}  // namespace isofield
