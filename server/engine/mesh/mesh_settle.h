// Settles the samples of a mesh that lie on the surface, up to rounding: it puts each of them on one side of the
// surface (shaders/lib/mesh_constants.glsl has the rule).
#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <span>

#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/brick_tapes.h"
#include "engine/mesh/mesh_layout.h"
#include "engine/mesh/mesh_rounding.h"
#include "engine/session.h"
#include "gpu/device.h"

namespace isofield::engine {

// Sets the members of `constants` that the rule needs; constants.iso must be set before.
void set_rounding(const MeshRounding& rounding, MeshConstants& constants);

// The samples of the bricks from `first` on, and the cases of the cells of all bricks.
struct SampledSlab {
  std::uint32_t first;
  const gpu::Buffer& samples;
  const gpu::Buffer& cases;
};

// Records a dispatch that finds out which corners of cells are inside, for constants.count bricks of the slab or, with
// kIsListed, for the bricks in `listed`. It sets near_bricks to 1 for each brick that has samples near the surface, and
// leaves the other entries as they are.
absl::Status classify(Session& session, const Kernels& kernels, const MeshConstants& constants, const SampledSlab& slab,
                      const gpu::Buffer& near_bricks, const gpu::Buffer& listed);

// Settles the samples on the surface in the bricks for which is_near is not 0, and classifies these bricks anew. Runs
// sessions of its own.
absl::Status settle_samples(gpu::Device& device, const Kernels& kernels, BrickTapes& tapes, MeshConstants constants,
                            const gpu::Buffer& bricks, const SampledSlab& slab, std::span<const std::uint32_t> is_near);

}  // namespace isofield::engine
