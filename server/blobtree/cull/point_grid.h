// PointGrid is a grid over a scene's support whose bricks each have a pruned tape. It is made once for many batches of
// points: a batch is sorted by brick in two passes, while bin_points() prunes anew for each.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/for_each.h"
#include "blobtree/cull/lattice.h"
#include "blobtree/cull/point_bins.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// A grid is immutable once made, so that any number of threads may sort at once.
class PointGrid {
 public:
  // Makes the grid of a tape, and sets `bricks` to those bricks where the field may differ from 0. FAILED_PRECONDITION:
  // the field is signed, or its support is empty or unbounded. RESOURCE_EXHAUSTED: the bricks' tapes take more than
  // kMostInstructions, since most primitives overlap. CANCELLED: `cancelled` has returned true.
  static absl::StatusOr<PointGrid> make(const Tape& tape, BrickList& bricks, const std::function<bool()>& cancelled);
  static constexpr std::size_t kMostInstructions = 1u << 21;

  struct Sorted {
    std::unique_ptr<PlacedPoint[]> points;  // sorted by brick
    std::vector<std::uint32_t> starts;      // where the points of each brick begin, those of no brick, and the end
  };
  // Sorts the points by brick. `xyz` holds 3 numbers for each point; a point with numbers that are not finite may be in
  // any bin. The points of a brick keep their order.
  Sorted sort(std::span<const float> xyz, const base::ForEach& for_each = {}) const;

 private:
  std::uint32_t brick_at(const float* p) const;

  std::array<float, 3> origin_{};
  float per_step_ = 0;
  std::array<std::uint32_t, 3> counts_{};
  // For each brick of the grid, x fastest: its index in the list, or bricks_ if it is not in the list.
  std::vector<std::uint32_t> places_;
  std::uint32_t bricks_ = 0;  // number of bricks in the list
};

}  // namespace isofield::blobtree
