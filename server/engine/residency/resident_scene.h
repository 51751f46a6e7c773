// A ResidentScene is a scene on the device: its tape, from which each request prunes the tapes that it needs, and the
// parameter buffers that kernels read.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "blobtree/tape/parameter_layout.h"
#include "blobtree/tape/tape.h"
#include "engine/residency/volume_cache.h"
#include "engine/session.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device.h"

namespace isofield::engine {

// Immutable, since an edit makes a new one, and so any thread may use it. A shared_ptr to it is the lease under which a
// request reads; the buffers are freed when the last lease is gone.
class ResidentScene : public std::enable_shared_from_this<ResidentScene> {
 public:
  // Uploads the tape's parameters and builds its volumes. Errors are those of the device and of VolumeCache::get().
  static absl::StatusOr<std::shared_ptr<const ResidentScene>> create(gpu::Device& device, VolumeCache& volumes,
                                                                     blobtree::Tape tape);
  // Returns a scene that differs from this one only in parameters of operators, as its `tape` has them. It shares the
  // leaves and the volumes with this one.
  absl::StatusOr<std::shared_ptr<const ResidentScene>> with_operations(gpu::Device& device, blobtree::Tape tape) const;

  const blobtree::Tape& tape() const { return tape_; }
  const blobtree::ParameterBuffers& parameters() const { return parameters_; }
  // Returns all bindings of a kernel that runs tapes pruned from this scene's: the scene's buffers, `code`, which holds
  // the tapes, and the kernel's own bindings.
  gpu::Commands::Bindings bindings(const gpu::Buffer& code, const gpu::Commands::Bindings& own) const;
  // Returns the bytes that the scene takes on the device. Volumes that it shares with other scenes count in full.
  std::uint64_t device_bytes() const;
  // Returns these bytes without volumes.
  std::uint64_t own_bytes() const { return leaves_->size() + operations_.size() + tables_.size(); }
  bool shares_leaves_with(const ResidentScene& other) const { return leaves_ == other.leaves_; }

 private:
  ResidentScene() = default;
  absl::Status upload_operations(Session& session);

  blobtree::Tape tape_;
  blobtree::ParameterBuffers parameters_;
  std::shared_ptr<const gpu::Buffer> leaves_;
  gpu::Buffer operations_, tables_;
  std::vector<VolumeLease> volumes_;  // in the order of the tape's volume slots
};

using SceneLease = std::shared_ptr<const ResidentScene>;

}  // namespace isofield::engine
