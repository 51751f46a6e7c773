// A request to the mesher, and the functions that the mesher calls while it works on it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "blobtree/cull/lattice.h"

namespace isofield::engine {

struct MeshRequest {
  double cell_size = 0;  // edge length of a cell, model units, > 0
  // The number of cells along the longest edge, if the client stated this and cell_size is derived from it. The
  // messages of errors speak of it then.
  std::optional<std::uint32_t> resolution;
  // The mesh is cut at these bounds, and closed there within a cell. Without bounds nothing is cut.
  std::optional<blobtree::Box> bounds;
  // The value of the field on the surface. For a positive field it is within ]0, 1[ and has no unit. For a signed field
  // it is a distance in model units, less than 0 inside and of magnitude at most base::kMaxCoordinate.
  double iso = 0.5;
  bool with_normals = true;
  double tolerance = 1e-3;  // the largest distance of vertices from the surface, as linearised; in cells, > 0
  std::uint64_t max_cells = 1u << 25;
  // If present, only these bricks of the mesh are made. There must be at least one. The lattice stays that of the
  // whole.
  std::optional<blobtree::BrickBox> part;
  // A mesh is made and handed over in parts; a part ends with the layer in which it reaches this many bricks. Larger
  // parts repeat less work for the bricks around them; smaller ones are sent sooner and take less memory.
  std::size_t bricks_at_once = 1u << 16;

  bool operator==(const MeshRequest&) const = default;
};

struct MeshCallbacks {
  std::function<void(double)> progress;  // receives the fraction that is done, within [0, 1], never decreasing
  std::function<void()> compiling;       // called when the work waits for the driver to compile a kernel
  std::function<bool()> cancelled;       // returns true if the mesher must give up with CANCELLED
};

}  // namespace isofield::engine
