// Decides which corners of a slab's bricks are evaluated, and which ones are copied from a neighbouring brick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/mesh/mesh_layout.h"

namespace isofield::engine {

// The samples of a brick are stored one after the other, x fastest.
inline constexpr std::size_t kCornersAlong = blobtree::kBrickCells + 1;
inline constexpr std::size_t kCornersPerBrick = kCornersAlong * kCornersAlong * kCornersAlong;

// The octets of a slab's bricks (corner_of_octet() of shaders/lib/mesh_samples.glsl).
struct SlabOctets {
  std::vector<std::uint16_t> evaluated;  // for each brick, the octets that are evaluated, a bit each
  // The octets that are copied: the brick that takes the octet over, the octet, the brick that owns its first four
  // corners, and the brick that owns its last four. Bricks are counted from `first`.
  std::vector<std::array<std::uint32_t, 4>> taken_over;
};
// Returns the octets of the bricks from `first` to before first + count. `neighbours` must come from
// brick_neighbours().
SlabOctets slab_octets(std::span<const std::uint32_t> neighbours, std::uint32_t first, std::uint32_t count);

}  // namespace isofield::engine
