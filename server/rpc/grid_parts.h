// How layers of a grid are cut into messages.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isofield::rpc {

// Points of a grid, along x, y and z.
struct GridPart {
  std::array<std::uint64_t, 3> first, counts;
};

// Parts of at most `most` points each, which is at least 1, of a grid of `counts` points: whole layers (of one z) where
// a part holds any, else rows of a layer, else points of a row. They follow one another in the grid's order, x fastest,
// without a gap.
std::vector<GridPart> grid_parts(const std::array<std::uint64_t, 3>& counts, std::uint64_t most);

}  // namespace isofield::rpc
