// A grid over a scene's support whose bricks each have their pruned tape, made once for many batches of points: a batch
// is sorted by brick in two passes, where bin_points() prunes anew for each.
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

// Immutable once made: any number of threads may sort at once.
class PointGrid {
 public:
  // FAILED_PRECONDITION: the field is signed, or its support is empty or has no end. RESOURCE_EXHAUSTED: the bricks'
  // tapes take more than kMostInstructions, since most primitives overlap. CANCELLED.
  // `bricks` becomes those where the field may differ from 0.
  static absl::StatusOr<PointGrid> make(const Tape& tape, BrickList& bricks, const std::function<bool()>& cancelled);
  static constexpr std::size_t kMostInstructions = 1u << 21;

  struct Sorted {
    std::unique_ptr<PlacedPoint[]> points;  // by brick
    std::vector<std::uint32_t> starts;      // where each brick's begin, those in no brick's, and the end
  };
  // `xyz` holds 3 numbers a point; where they are not finite, the point is in any bin. Within a brick they keep their
  // order.
  Sorted sort(std::span<const float> xyz, const base::ForEach& for_each = {}) const;

 private:
  std::uint32_t brick_at(const float* p) const;

  std::array<float, 3> origin_{};
  float per_step_ = 0;
  std::array<std::uint32_t, 3> counts_{};
  std::vector<std::uint32_t> places_;  // of the grid's bricks in the list of them, x fastest; its size: none
  std::uint32_t bricks_ = 0;           // in the list
};

}  // namespace isofield::blobtree
