// The mesher's passes that number a part's vertices and quads and list them by brick (shaders/mesh_connect.comp,
// mesh_list.comp).
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
  std::vector<MeshStart> starts;  // first vertex and first quad of each brick, and the totals
  gpu::Buffer starts_buffer;
  gpu::Buffer cells;            // a word each, as shaders/lib/mesh_constants.glsl states
  gpu::Buffer vertices, quads;  // the lists

  std::uint32_t vertex_count() const { return starts.back()[0]; }
  std::uint32_t quad_count() const { return starts.back()[1]; }
  bool has_vertices(std::uint32_t brick) const { return starts[brick + 1][0] > starts[brick][0]; }
  bool has_quads(std::uint32_t brick) const { return starts[brick + 1][1] > starts[brick][1]; }
};

// The cells, and how many elements each brick has. RESOURCE_EXHAUSTED: more than the device holds in a buffer.
absl::StatusOr<PartElements> connect_cells(PartOnDevice& part, const PartSamples& samples);
// What is left of them.
absl::Status list_elements(PartOnDevice& part, PartElements& elements);

}  // namespace isofield::engine
