// How fine the cells of a lattice have to be for a scene, and how fine they can be.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "base/for_each.h"
#include "blobtree/tape/tape.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// The largest cell, in radii of a primitive, that cannot tear it apart: a ball of radius r holds a corner of a cubic
// lattice wherever it lies when a cell's edge is at most 2 r / sqrt(3), and corners of balls along a path are joined by
// edges of cells.
inline constexpr double kCoarsestCellOfRadius = 1.1547;

// Primitives for which a cell is too coarse: with the thinnest of them.
struct ThinPrimitives {
  std::uint32_t node = 0;        // in Scene::nodes: the thinnest primitive
  double thickness = 0;          // twice the least radius of that primitive where the field is iso; model units
  double cell_size = 0;          // the largest cell that is fine enough for it
  std::uint64_t primitives = 0;  // how many are too thin
};
// Nothing: request.cell_size is fine enough for every primitive within the bounds.
std::optional<ThinPrimitives> too_thin(const blobtree::Tape& tape, const MeshRequest& request);

// A cell size for a request that states none: the thinnest primitive is two cells across and the longest edge at least
// kAutomaticCellsAlong, or as fine as request.max_cells admits.
inline constexpr double kAutomaticCellsAlong = 200;
absl::StatusOr<double> automatic_cell_size(const blobtree::Tape& tape, const MeshRequest& request,
                                           const std::function<bool()>& cancelled = {},
                                           const base::ForEach& for_each = {});

// Whether request.cell_size takes far more bricks than max_bricks, by the primitives' areas and by what coarse lattices
// take; costs milliseconds. False where that is in doubt.
absl::StatusOr<bool> is_far_too_fine(const blobtree::Tape& tape, const MeshRequest& request, std::uint64_t max_bricks,
                                     const std::function<bool()>& cancelled);

// The smallest cell size whose bricks are admitted.
struct FittingCell {
  double size = 0;
  // Found to a few per cent. Otherwise what coarse lattices take was extrapolated, which costs milliseconds.
  bool is_exact = true;
};
absl::StatusOr<FittingCell> fitting_cell(const blobtree::Tape& tape, const MeshRequest& request,
                                         std::uint64_t max_bricks, const std::function<bool()>& cancelled);

}  // namespace isofield::engine
