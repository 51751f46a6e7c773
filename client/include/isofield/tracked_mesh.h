// Meshes that a server keeps up to date while their scenes are edited.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "isofield/mesh.h"
#include "isofield/v1/mesh_service.pb.h"
#include "isofield/v1/scene_service.pb.h"

namespace isofield {

// The changes that one answer of the server made to a tracked mesh.
struct MeshChanges {
  // True where the answer is the whole mesh, which replaces all that was known.
  bool is_whole = false;
  // The number of bricks that are new or replace earlier ones.
  std::size_t bricks_put = 0;
  // The number of bricks that hold nothing any more. A whole answer removes all bricks that were known.
  std::size_t bricks_removed = 0;
};

// A mesh that a server keeps up to date while its scene is edited. Client::track_mesh() makes it. The object owns one
// open stream, which ends with it, and may outlive the client. Only one thread at a time may use it, except for
// cancel().
//
// An error ends the stream: every later call returns the same status, and bricks() may hold a part of the answer that
// failed. Edits that were made before stay in the scene.
class TrackedMesh {
 public:
  TrackedMesh(TrackedMesh&&) noexcept;
  TrackedMesh& operator=(TrackedMesh&&) noexcept;
  ~TrackedMesh();

  // Edits the scene as Client::edit_parameters() does, and brings the mesh up to date, also with what others have
  // stored or edited. `expected_version` 0 means any version. Returns the summary of the mesh; its counts are those of
  // the whole mesh.
  absl::StatusOr<v1::MeshSummary> edit(const std::vector<v1::ParameterEdit>& edits, std::uint64_t expected_version = 0);
  // Brings the mesh up to date with what others have stored or edited.
  absl::StatusOr<v1::MeshSummary> refresh();
  // Ends the stream; a call that waits for an answer returns CANCELLED. Any thread may call this.
  void cancel();

  // The mesh after the last answer.
  const BrickMesh& bricks() const;
  // The summary and the changes of the last answer. The first answer is the whole mesh that Client::track_mesh() waits
  // for.
  const v1::MeshSummary& summary() const;
  const MeshChanges& changes() const;

 private:
  friend class Client;
  struct Impl;
  explicit TrackedMesh(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield
