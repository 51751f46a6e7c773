// Which primitive a point of the surface belongs to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

inline constexpr std::uint32_t kNoLeaf = ~0u;

// For each point the place in tape.leaves of the primitive whose own surface is nearest to it, among those whose field
// makes a difference there; kNoLeaf where there is none. Of equally near ones the first. `xyz` holds 3 finite numbers a
// point.
std::vector<std::uint32_t> nearest_leaves(const Tape& tape, std::span<const float> xyz);

}  // namespace isofield::blobtree
