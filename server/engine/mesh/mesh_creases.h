// Finds the bricks in which a scene's surface may have creases, so that the mesher looks for creases only there.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "blobtree/tape/tape.h"
#include "engine/mesh/mesh_layout.h"

namespace isofield::engine {

// Returns kKnowsCrossings and kMayCrease of every brick, which it finds from the brick's tape. `neighbours` must come
// from brick_neighbours(). Sums, round shapes, and blends that never become a sharp union where gradients differ by 30
// to 150 degrees make no crease.
std::vector<std::uint32_t> brick_kinds(const blobtree::Tape& tape, const blobtree::BrickList& list,
                                       const std::vector<std::uint32_t>& neighbours);

}  // namespace isofield::engine
