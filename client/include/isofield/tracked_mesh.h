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

// What an answer changed in a mesh that is tracked.
struct MeshChanges {
  // All that was known is void: the answer is the mesh.
  bool is_whole = false;
  // Bricks that are new, or in place of those that were there.
  std::size_t bricks_put = 0;
  // Bricks that hold nothing any more; of a whole answer, all that were known.
  std::size_t bricks_removed = 0;
};

// A mesh that a server keeps up to date while its scene is edited: one open stream, which ends with the object. Made by
// Client::track_mesh, and may outlive the client. One thread at a time, but for cancel.
//
// Errors end the stream: every later call returns the same status, and bricks() may hold a part of the answer that
// failed. Edits that were made stay.
class TrackedMesh {
 public:
  TrackedMesh(TrackedMesh&&) noexcept;
  TrackedMesh& operator=(TrackedMesh&&) noexcept;
  ~TrackedMesh();

  // Edits the scene as Client::edit_parameters does, and follows: with what others have put or edited, too.
  // `expected_version` 0: any. Returns the summary of the mesh, its counts of the whole.
  absl::StatusOr<v1::MeshSummary> edit(const std::vector<v1::ParameterEdit>& edits, std::uint64_t expected_version = 0);
  // Follows what others have put or edited.
  absl::StatusOr<v1::MeshSummary> refresh();
  // From any thread: ends the stream; a call that waits returns CANCELLED.
  void cancel();

  // The mesh after the last answer.
  const BrickMesh& bricks() const;
  // Of the last answer; the first one is track_mesh's, which is whole.
  const v1::MeshSummary& summary() const;
  const MeshChanges& changes() const;

 private:
  friend class Client;
  struct Impl;
  explicit TrackedMesh(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield
