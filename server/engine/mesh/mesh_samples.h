// Which corners of a mesh's bricks are evaluated, and which are taken over from the brick beside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isofield::engine {

// The corners of a brick in parts of up to eight (corner_of_part() of shaders/lib/mesh_samples.glsl): those at which it
// begins in parts 0 to 7, those on its upper faces, which are others' own, in parts 8 to 15.
inline constexpr std::uint32_t kSampleParts = 16, kOwnSampleParts = 8;
// Parts that a workgroup of shaders/mesh_sample.comp takes, and of mesh_share.comp and mesh_settle.comp.
inline constexpr std::uint32_t kSamplePartsPerGroup = 8;

struct SampleParts {
  std::vector<std::uint16_t> evaluated;  // of each brick: its parts, a bit each
  // The brick that takes a part over, the part, and the bricks whose own its first and its last four corners are: all
  // bricks counted from `first`.
  std::vector<std::array<std::uint32_t, 4>> taken_over;
};
// Of bricks `first` up to first + count, `neighbours` as of brick_neighbours().
SampleParts sample_parts(std::span<const std::uint32_t> neighbours, std::uint32_t first, std::uint32_t count);

}  // namespace isofield::engine
