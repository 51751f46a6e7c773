// Cuts layers of a grid into messages.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isofield::rpc {

// A box of points of a grid: its first point and the number of points, along x, y and z.
struct GridPart {
  std::array<std::uint64_t, 3> first, counts;
};

// Cuts a grid of `counts` points into parts of at most `most` points, which is at least 1. A part has whole layers (of
// one z) where it can hold one, else whole rows of a layer, else points of a row. The parts follow one another without
// a gap in the grid's order, x fastest.
std::vector<GridPart> grid_parts(const std::array<std::uint64_t, 3>& counts, std::uint64_t most);

}  // namespace isofield::rpc
