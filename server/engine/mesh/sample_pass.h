// The first passes of the mesher. They sample the field at the corners of a part's bricks, and find out which corners
// of cells are inside (shaders/mesh_sample.comp, mesh_share.comp, mesh_classify.comp; mesh_settle.h).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <vector>

#include "engine/mesh/part_on_device.h"
#include "gpu/buffer.h"

namespace isofield::engine {

// The bricks of a part from `first` to before first + count, and the samples of their corners.
struct MeshSlab {
  std::uint32_t first, count;
  gpu::Buffer samples;
};

struct PartSamples {
  std::vector<MeshSlab> slabs;  // all bricks of the part, in their order
  gpu::Buffer cases;            // a byte a cell: its inside corners, a bit each
};

// Runs these passes. CANCELLED: the request was cancelled.
absl::StatusOr<PartSamples> sample_corners(PartOnDevice& part);

}  // namespace isofield::engine
