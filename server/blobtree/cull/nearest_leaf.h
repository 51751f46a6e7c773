// nearest_leaves() finds the primitive that a point of the surface belongs to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

inline constexpr std::uint32_t kNoLeaf = ~0u;

// Returns for each point the index in tape.leaves of the primitive whose own surface is nearest to it, among those
// whose field makes a difference there; kNoLeaf if there is none. The first one counts if several are equally near.
// `xyz` holds 3 finite numbers for each point.
std::vector<std::uint32_t> nearest_leaves(const Tape& tape, std::span<const float> xyz);

}  // namespace isofield::blobtree
