// Sorts a batch of points into groups that lie close together, each with a pruned tape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "blobtree/cull/pruner.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Of a batch: with its place there. What reads points in another order than the batch's finds these side by side.
struct PlacedPoint {
  float x, y, z;
  std::uint32_t place;
};

struct PointGroup {
  std::uint32_t first, count;            // in PointBins::points
  std::uint32_t tape_begin, tape_count;  // 0 instructions: the field is 0
};

struct PointBins {
  std::unique_ptr<PlacedPoint[]> points;  // null: the batch as it is, in one group
  std::vector<PointGroup> groups;         // that hold every point once
  std::vector<Instruction> code;
};

// Tapes of so few instructions are not worth sorting points for.
inline constexpr std::size_t kUnsortedInstructions = 12;

// `xyz` holds 3 numbers a point, of which those that are not finite are taken for 0. All of them are one group where
// the tape is not worth sorting for.
PointBins bin_points(const Tape& tape, std::span<const float> xyz);

}  // namespace isofield::blobtree
