// A request to the mesher.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "blobtree/cull/lattice.h"

namespace isofield::engine {

struct MeshRequest {
  double cell_size = 0;  // > 0
  // Cells along the longest edge, where the request states these and cell_size is derived: refusals speak of it.
  std::optional<std::uint32_t> resolution;
  // Where the surface leaves the bounds, the mesh is capped within a cell. Without bounds nothing is cut.
  std::optional<blobtree::Box> bounds;
  double iso = 0.5;  // within ]0, 1[
  bool with_normals = true;
  double tolerance = 1e-3;  // of vertices' distances from the surface, as linearised, in cells; > 0
  std::uint64_t max_cells = 1u << 25;
  // Only these bricks of the mesh are made, of which there must be at least one. The lattice is that of the whole mesh.
  std::optional<blobtree::BrickBox> part;
  // A part that is made and handed over at once ends with the layer in which it reaches so many bricks. Larger parts
  // repeat less of what lies around them; smaller ones are sent sooner and take less memory.
  std::size_t bricks_at_once = 1u << 16;

  bool operator==(const MeshRequest&) const = default;
};

struct MeshCallbacks {
  std::function<void(double)> progress;  // fraction within [0, 1], never decreasing
  std::function<void()> compiling;       // called when the work waits for the driver to compile a kernel
  std::function<bool()> cancelled;       // true: give up with CANCELLED
};

}  // namespace isofield::engine
