// Cuts a grid of points, or some of its layers, into parts that fit into messages.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isofield::rpc {

// A box of points of a grid: its first point and the number of points, along x, y and z.
struct GridPart {
  std::array<std::uint64_t, 3> first, counts;
};

// Cuts a grid of `counts` points into parts of at most `most` points; `most` is at least 1. A part has whole layers (of
// one z) if it can hold one, else whole rows of a layer, else points of one row. The parts follow one another without a
// gap in the order of the grid, in which x runs fastest.
std::vector<GridPart> grid_parts(const std::array<std::uint64_t, 3>& counts, std::uint64_t most);

}  // namespace isofield::rpc
