// A part of a mesh on its way through the mesher's passes: what the host knows of its bricks, and what of this lies on
// the device.
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

// One thread. What it is given must outlive it.
struct PartOnDevice {
  PartOnDevice(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene, const MeshRequest& request,
               PartBricks part, const MeshCallbacks& callbacks);
  PartOnDevice(const PartOnDevice&) = delete;
  PartOnDevice& operator=(const PartOnDevice&) = delete;

  // Before the first pass.
  absl::Status upload();

  std::uint32_t total() const { return static_cast<std::uint32_t>(list.bricks.size()); }
  bool is(std::uint32_t brick, BrickKind kind) const { return (kinds[brick] & kind) != 0; }
  // Tells the progress. CANCELLED: the request was.
  absl::Status check(double fraction) const;

  gpu::Device& device;
  const Kernels kernels;
  const ResidentScene& scene;
  const MeshRequest& request;
  const MeshCallbacks& callbacks;
  const MeshConstants constants;

  // Its code has gone to `tapes`, in whose windows the bricks' tapes begin.
  blobtree::BrickList list;
  const std::uint32_t owned, placed, crossed;   // as of PartBricks
  const std::vector<std::uint32_t> neighbours;  // as of brick_neighbours()
  std::vector<std::uint32_t> kinds;             // of bricks: BrickKind
  BrickTapes tapes;
  gpu::Buffer bricks, neighbours_buffer, surface_cases;
};

}  // namespace isofield::engine
