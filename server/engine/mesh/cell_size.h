// Finds cell sizes for a scene: how fine the cells of a lattice must be for its thinnest primitive, and how fine they
// can be within a limit on their number.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "base/for_each.h"
#include "blobtree/tape/tape.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// The largest cell, in radii of a primitive, that cannot tear the primitive apart. If a cell's edge is at most
// 2 r / sqrt(3), a ball of radius r holds a corner of the cubic lattice wherever it lies, and edges of cells join the
// corners in balls along a path.
inline constexpr double kCoarsestCellOfRadius = 1.1547;

// The primitives for which a cell is too coarse, and the thinnest of them.
struct ThinPrimitives {
  std::uint32_t node = 0;        // the thinnest primitive, in Scene::nodes
  double thickness = 0;          // twice the least radius of that primitive where its field is iso; model units
  double cell_size = 0;          // the largest cell that is fine enough for it; model units
  std::uint64_t primitives = 0;  // how many primitives are too thin
};
// Returns nothing if request.cell_size is fine enough for every primitive within the bounds.
std::optional<ThinPrimitives> too_thin(const blobtree::Tape& tape, const MeshRequest& request);

// Returns a cell size for a request that states none: the thinnest primitive is at least two cells across, and the
// longest edge at least kAutomaticCellsAlong cells. If request.max_cells does not admit this, the size is the finest
// that fits.
inline constexpr double kAutomaticCellsAlong = 200;
absl::StatusOr<double> automatic_cell_size(const blobtree::Tape& tape, const MeshRequest& request,
                                           const std::function<bool()>& cancelled = {},
                                           const base::ForEach& for_each = {});

// Returns true if request.cell_size takes far more bricks than max_bricks. It estimates that in milliseconds, from the
// primitives' areas and from the bricks of coarse lattices; it returns false if the estimates leave a doubt.
absl::StatusOr<bool> is_far_too_fine(const blobtree::Tape& tape, const MeshRequest& request, std::uint64_t max_bricks,
                                     const std::function<bool()>& cancelled);

// The smallest cell size whose bricks are admitted.
struct FittingCell {
  double size = 0;  // model units
  // True: found to a few per cent. False: extrapolated from coarse lattices, which takes only milliseconds.
  bool is_exact = true;
};
absl::StatusOr<FittingCell> fitting_cell(const blobtree::Tape& tape, const MeshRequest& request,
                                         std::uint64_t max_bricks, const std::function<bool()>& cancelled);

}  // namespace isofield::engine
