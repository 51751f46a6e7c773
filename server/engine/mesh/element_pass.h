// The passes of the mesher that number a part's vertices and quads, its elements, and list them by brick
// (shaders/mesh_connect.comp, mesh_list.comp).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh_layout.h"
#include "engine/mesh/part_on_device.h"
#include "engine/mesh/sample_pass.h"
#include "gpu/buffer.h"

namespace isofield::engine {

struct PartElements {
  std::vector<MeshStart> starts;  // first vertex and first quad of each brick, then the totals
  gpu::Buffer starts_buffer;
  gpu::Buffer cells;            // a word a cell, as shaders/lib/mesh_constants.glsl states
  gpu::Buffer vertices, quads;  // the lists, by brick

  std::uint32_t vertex_count() const { return starts.back()[0]; }
  std::uint32_t quad_count() const { return starts.back()[1]; }
  bool has_vertices(std::uint32_t brick) const { return starts[brick + 1][0] > starts[brick][0]; }
  bool has_quads(std::uint32_t brick) const { return starts[brick + 1][1] > starts[brick][1]; }
};

// Checks that buffers of the device hold so many elements. RESOURCE_EXHAUSTED: they do not.
absl::Status check_elements(const MeshRequest& request, std::uint64_t vertices, std::uint64_t quads,
                            std::uint64_t max_buffer_bytes);

// Fills in the cells, and counts the elements of each brick (`starts`). RESOURCE_EXHAUSTED: there are more elements
// than a buffer of the device holds.
absl::StatusOr<PartElements> connect_cells(PartOnDevice& part, const PartSamples& samples);
// Fills in the other members of `elements`.
absl::Status list_elements(PartOnDevice& part, PartElements& elements);

}  // namespace isofield::engine
