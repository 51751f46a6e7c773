// A scene on the device: its tape, from which requests prune theirs, with the parameter buffers that kernels read.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "blobtree/tape.h"
#include "engine/volume_cache.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device.h"

namespace isofield::engine {

// Immutable: an edit makes a new one. A shared_ptr to it is the lease under which a request reads; the buffers go when
// the last lease does.
class ResidentScene {
 public:
  static absl::StatusOr<std::shared_ptr<const ResidentScene>> create(gpu::Device& device, VolumeCache& volumes,
                                                                     blobtree::Tape tape);

  const blobtree::Tape& tape() const { return tape_; }
  // The bindings of a kernel that runs tapes pruned from this scene's, which lie in `code`, with its own ones.
  gpu::Commands::Bindings bindings(const gpu::Buffer& code, const gpu::Commands::Bindings& own) const;
  // Volumes that it shares with others count whole.
  std::uint64_t device_bytes() const;

 private:
  ResidentScene() = default;

  blobtree::Tape tape_;
  gpu::Buffer leaves_, operations_, tables_;
  std::vector<VolumeLease> volumes_;  // by slot
};

using SceneLease = std::shared_ptr<const ResidentScene>;

}  // namespace isofield::engine
