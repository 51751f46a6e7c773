// Where a scene's surface may have creases: elsewhere the mesher need not look for any.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "blobtree/tape/tape.h"
#include "engine/mesh/mesh_layout.h"

namespace isofield::engine {

// kKnowsCrossings and kMayCrease of every brick, from its tape. `neighbours` as brick_neighbours gives them. Sums,
// blends that never become a sharp union where gradients differ by 30 to 150 degrees, and round shapes make no crease.
std::vector<std::uint32_t> brick_kinds(const blobtree::Tape& tape, const blobtree::BrickList& list,
                                       const std::vector<std::uint32_t>& neighbours);

}  // namespace isofield::engine
