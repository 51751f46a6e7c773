// PartOnDevice is a part of a mesh on its way through the mesher's passes. It holds what the passes share: the part's
// bricks on the host and on the device, the tapes and the constants.
#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <vector>

#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/brick_tapes.h"
#include "engine/mesh/mesh_layout.h"
#include "engine/mesh/mesh_part.h"
#include "engine/mesh/mesh_request.h"
#include "engine/residency/resident_scene.h"
#include "gpu/buffer.h"
#include "gpu/device.h"

namespace isofield::engine {

// Belongs to one thread. What is given by reference must outlive it.
struct PartOnDevice {
  PartOnDevice(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene, const MeshRequest& request,
               PartBricks part, const MeshCallbacks& callbacks);
  PartOnDevice(const PartOnDevice&) = delete;
  PartOnDevice& operator=(const PartOnDevice&) = delete;

  // Uploads the buffers below. Call it once, before the first pass.
  absl::Status upload();

  std::uint32_t total() const { return static_cast<std::uint32_t>(list.bricks.size()); }
  bool is(std::uint32_t brick, BrickKind kind) const { return (kinds[brick] & kind) != 0; }
  // Reports the fraction that is done. CANCELLED: the request was cancelled.
  absl::Status check(double fraction) const;

  gpu::Device& device;
  const Kernels kernels;
  const ResidentScene& scene;
  const MeshRequest& request;
  const MeshCallbacks& callbacks;
  const MeshConstants constants;

  // The bricks. Their code has moved to `tapes`, and their tapes begin at places in its windows.
  blobtree::BrickList list;
  const std::uint32_t owned, placed, crossed;   // as in PartBricks
  const std::vector<std::uint32_t> neighbours;  // as brick_neighbours() returns them
  std::vector<std::uint32_t> kinds;             // BrickKind bits of each brick
  BrickTapes tapes;
  gpu::Buffer bricks, neighbours_buffer, surface_cases;
};

}  // namespace isofield::engine
