// Puts the samples of a mesh that are on the surface on one side of it: shaders/lib/mesh_constants.glsl has the rule.
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

void set_rounding(const MeshRounding& rounding, MeshConstants& constants);

// Samples of bricks from `first` on, and the cases of all bricks' cells.
struct SampledSlab {
  std::uint32_t first;
  const gpu::Buffer& samples;
  const gpu::Buffer& cases;
};

// Records which corners of cells are inside: of constants.count bricks of the slab or, with kIsListed, of those that
// are listed. near_bricks becomes 1 for each that has samples near the surface, and else stays.
absl::Status classify(Session& session, const Kernels& kernels, const MeshConstants& constants, const SampledSlab& slab,
                      const gpu::Buffer& near_bricks, const gpu::Buffer& listed);

// Settles the samples that are on the surface of bricks for which is_near is not 0, and classifies these anew.
absl::Status settle_samples(gpu::Device& device, const Kernels& kernels, BrickTapes& tapes, MeshConstants constants,
                            const gpu::Buffer& bricks, const SampledSlab& slab, std::span<const std::uint32_t> is_near);

}  // namespace isofield::engine
