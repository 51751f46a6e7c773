// bin_points() sorts a batch of points into groups that lie close together, each with a pruned tape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "blobtree/cull/pruner.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// PlacedPoint is a point of a batch with its place in the batch. Code that reads the points in another order than the
// batch's finds both side by side.
struct PlacedPoint {
  float x, y, z;
  std::uint32_t place;
};

// A PointGroup is a group of points that share a pruned tape.
struct PointGroup {
  std::uint32_t first, count;            // range in PointBins::points
  std::uint32_t tape_begin, tape_count;  // range in PointBins::code; if it is empty, the field is 0
};

// PointBins is the result of bin_points().
struct PointBins {
  std::unique_ptr<PlacedPoint[]> points;  // null if the batch stays as it is, in one group
  std::vector<PointGroup> groups;         // hold every point once
  std::vector<Instruction> code;
};

// Sorting points takes longer than it saves for tapes of at most this many instructions.
inline constexpr std::size_t kUnsortedInstructions = 12;

// Sorts the points into groups. `xyz` holds 3 numbers for each point; numbers that are not finite are taken for 0. All
// points are one group if sorting would not save time.
PointBins bin_points(const Tape& tape, std::span<const float> xyz);

}  // namespace isofield::blobtree
