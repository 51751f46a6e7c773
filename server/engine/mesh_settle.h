// Puts the samples of a mesh that are on the surface on one side of it: shaders/lib/mesh_constants.glsl has the rule.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>

#include "engine/brick_tapes.h"
#include "engine/kernel_cache.h"
#include "engine/mesh_constants.h"
#include "engine/mesh_rounding.h"
#include "gpu/device.h"

namespace isofield::engine {

void set_rounding(const MeshRounding& rounding, MeshConstants& constants);

// Of the samples of bricks from `first` on; is_near, of each: not 0 where some sample may be on the surface. False: no
// brick has such a sample, and nothing was done.
absl::StatusOr<bool> settle_samples(gpu::Device& device, KernelCache& kernels, BrickTapes& tapes,
                                    MeshConstants constants, const gpu::Buffer& bricks, std::uint32_t first,
                                    std::span<const std::uint32_t> is_near, const gpu::Buffer& samples);

}  // namespace isofield::engine
