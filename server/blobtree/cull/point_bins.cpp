#include "blobtree/cull/point_bins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isofield::blobtree {
namespace {

// The points of a tape of at most kShortTape instructions are evaluated without more sorting, and a group of at most
// kSmallGroup points is not split. A split costs each point about as much as some tens of instructions.
constexpr std::size_t kShortTape = kUnsortedInstructions / 2;
constexpr std::uint32_t kSmallGroup = 48;

// Binner does the work of one bin_points().
class Binner {
 public:
  Binner(const Tape& tape, std::span<const float> xyz) : xyz_(xyz), pruner_(tape), tape_(tape) {}

  PointBins run() {
    const auto count = static_cast<std::uint32_t>(xyz_.size() / 3);
    if (count == 0) return std::move(bins_);
    if (tape_.code.size() <= kUnsortedInstructions) {
      bins_.code = tape_.code;
      bins_.groups.push_back({0, count, 0, static_cast<std::uint32_t>(tape_.code.size())});
      return std::move(bins_);
    }
    bins_.points = std::make_unique_for_overwrite<PlacedPoint[]>(count);
    const auto finite = [&](std::uint32_t n) {
      const float x = xyz_[n];
      return std::isfinite(x) ? x : 0;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      bins_.points[i] = {finite(3 * i), finite(3 * i + 1), finite(3 * i + 2), i};
    }
    scratch_ = std::make_unique_for_overwrite<PlacedPoint[]>(count);
    arena_ = tape_.code;
    levels_.push_back({0, arena_.size()});
    stack_.push_back({0, count, 0});
    while (!stack_.empty()) {
      const Range range = stack_.back();
      stack_.pop_back();
      visit(range);
    }
    return std::move(bins_);
  }

 private:
  struct Range {
    std::uint32_t first, count;
    std::size_t parent;  // index in levels_
  };
  struct Level {
    std::size_t begin, count;  // in arena_
  };

  std::span<PlacedPoint> points(const Range& range) const { return {&bins_.points[range.first], range.count}; }

  Box box_of(const Range& range) const {
    float lo[3], hi[3];
    std::fill(lo, lo + 3, std::numeric_limits<float>::infinity());
    std::fill(hi, hi + 3, -std::numeric_limits<float>::infinity());
    for (const PlacedPoint& p : points(range)) {
      lo[0] = std::min(lo[0], p.x), hi[0] = std::max(hi[0], p.x);
      lo[1] = std::min(lo[1], p.y), hi[1] = std::max(hi[1], p.y);
      lo[2] = std::min(lo[2], p.z), hi[2] = std::max(hi[2], p.z);
    }
    return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
  }

  void visit(const Range& range) {
    levels_.resize(range.parent + 1);
    const Level parent = levels_[range.parent];
    const std::size_t begin = parent.begin + parent.count;
    arena_.resize(begin);
    const Box box = box_of(range);
    const bool is_zero = pruner_.prune(arena_, parent.begin, parent.count, box, arena_).is_zero;
    const std::size_t count = is_zero ? 0 : arena_.size() - begin;
    if (count <= kShortTape || range.count <= kSmallGroup || !(box.min != box.max)) {
      bins_.groups.push_back(
          {range.first, range.count, static_cast<std::uint32_t>(bins_.code.size()), static_cast<std::uint32_t>(count)});
      bins_.code.insert(bins_.code.end(), arena_.begin() + begin, arena_.end());
      return;
    }
    levels_.push_back({begin, count});
    split(range, box);
  }

  // Sorts the range into the eight octants of its box.
  void split(const Range& range, const Box& box) {
    const dvec3 c = (box.min + box.max) * 0.5;
    const auto octant = [&](const PlacedPoint& p) {
      return (p.x > c.x ? 1 : 0) | (p.y > c.y ? 2 : 0) | (p.z > c.z ? 4 : 0);
    };
    std::array<std::uint32_t, 9> starts{};
    for (const PlacedPoint& p : points(range)) ++starts[octant(p) + 1];
    for (int o = 0; o < 8; ++o) starts[o + 1] += starts[o];
    std::array<std::uint32_t, 8> next;
    std::copy_n(starts.begin(), 8, next.begin());
    for (const PlacedPoint& p : points(range)) scratch_[next[octant(p)]++] = p;
    std::copy_n(scratch_.get(), range.count, points(range).begin());
    for (int o = 7; o >= 0; --o) {
      const std::uint32_t count = starts[o + 1] - starts[o];
      if (count > 0) stack_.push_back({range.first + starts[o], count, levels_.size() - 1});
    }
  }

  std::span<const float> xyz_;
  Pruner pruner_;
  const Tape& tape_;
  PointBins bins_;
  std::unique_ptr<PlacedPoint[]> scratch_;
  std::vector<Instruction> arena_;
  std::vector<Level> levels_;
  std::vector<Range> stack_;
};

}  // namespace

PointBins bin_points(const Tape& tape, std::span<const float> xyz) {
  return Binner(tape, xyz).run();
}

}  // namespace isofield::blobtree
