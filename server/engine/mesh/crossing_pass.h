// The pass of the mesher that finds where the surface crosses edges of the lattice, and its normals there
// (shaders/mesh_crossings.comp).
#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <functional>

#include "engine/mesh/element_pass.h"
#include "engine/mesh/part_on_device.h"
#include "engine/mesh/sample_pass.h"
#include "gpu/buffer.h"

namespace isofield::engine {

// Finds the crossings of the quads' edges in the slab's wanted bricks, and writes them to `crossings`, which has 3
// numbers for each quad of the part.
absl::Status find_crossings(PartOnDevice& part, const MeshSlab& slab, const PartElements& elements,
                            const gpu::Buffer& crossings, const std::function<bool(std::uint32_t brick)>& is_wanted);

}  // namespace isofield::engine
