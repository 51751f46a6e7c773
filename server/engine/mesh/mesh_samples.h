// Which corners of a mesh's bricks are evaluated, and which are taken over from the brick beside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/mesh/mesh_layout.h"

namespace isofield::engine {

// A brick's samples lie one after the other, x fastest.
inline constexpr std::size_t kCornersAlong = blobtree::kBrickCells + 1;
inline constexpr std::size_t kCornersPerBrick = kCornersAlong * kCornersAlong * kCornersAlong;

// The octets of a slab's bricks (corner_of_octet() of shaders/lib/mesh_samples.glsl).
struct SlabOctets {
  std::vector<std::uint16_t> evaluated;  // of each brick: its octets, a bit each
  // The brick that takes an octet over, the octet, and the bricks whose own its first and its last four corners are.
  // All bricks are counted from `first`.
  std::vector<std::array<std::uint32_t, 4>> taken_over;
};
// Of bricks `first` up to first + count, `neighbours` as of brick_neighbours().
SlabOctets slab_octets(std::span<const std::uint32_t> neighbours, std::uint32_t first, std::uint32_t count);

}  // namespace isofield::engine
