// The mesher's first passes: the field at the corners of a part's bricks, and which corners of their cells are inside
// (shaders/mesh_sample.comp, mesh_share.comp, mesh_classify.comp; mesh_settle.h).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <vector>

#include "engine/mesh/part_on_device.h"
#include "gpu/buffer.h"

namespace isofield::engine {

// Bricks `first` up to first + count of a part, and the samples of their corners.
struct MeshSlab {
  std::uint32_t first, count;
  gpu::Buffer samples;
};

struct PartSamples {
  std::vector<MeshSlab> slabs;  // of all the part's bricks, in their order
  gpu::Buffer cases;            // a byte a cell: its inside corners
};

absl::StatusOr<PartSamples> sample_corners(PartOnDevice& part);

}  // namespace isofield::engine
