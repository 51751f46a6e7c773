// Sorts a batch of points into groups that lie close together, each with a pruned tape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/pruner.h"
#include "blobtree/tape.h"

namespace isofield::blobtree {

// Of a batch: with its place there. What reads points in another order than the batch's finds these side by side.
struct PlacedPoint {
  float x, y, z;
  std::uint32_t place;
};

struct PointGroup {
  std::uint32_t first, count;  // in PointBins::order
  std::uint32_t tape_begin, tape_count;  // 0 instructions: the field is 0
};

struct PointBins {
  // Places in the batch; empty: the batch as it is, in one group.
  std::vector<std::uint32_t> order;
  std::vector<PointGroup> groups;  // that hold every point once
  std::vector<Instruction> code;
};

// `xyz` holds 3 finite numbers a point. Short tapes are not worth sorting for and go through in one group.
PointBins bin_points(const Tape& tape, std::span<const float> xyz);

}  // namespace isofield::blobtree
