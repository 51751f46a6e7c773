#include "blobtree/point_bins.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isofield::blobtree {
namespace {

// Instructions a tape may have for its points to be evaluated without more sorting, and points that a group is not
// split below: a split costs about as much as evaluating some tens of point-instructions a point.
constexpr std::size_t kShortTape = 6;
constexpr std::uint32_t kSmallGroup = 48;

class Binner {
 public:
  Binner(const Tape& tape, std::span<const float> xyz) : xyz_(xyz), pruner_(tape), tape_(tape) {}

  PointBins run() {
    const auto count = static_cast<std::uint32_t>(xyz_.size() / 3);
    if (count == 0) return std::move(bins_);
    if (tape_.code.size() <= 2 * kShortTape) {
      bins_.code = tape_.code;
      bins_.groups.push_back({0, count, 0, static_cast<std::uint32_t>(tape_.code.size())});
      return std::move(bins_);
    }
    bins_.order.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) bins_.order[i] = i;
    scratch_.resize(count);
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
    std::size_t parent;  // in levels_
  };
  struct Level {
    std::size_t begin, count;  // in arena_
  };

  const float* point(std::uint32_t i) const { return &xyz_[3 * std::size_t{bins_.order[i]}]; }

  Box box_of(const Range& range) const {
    float lo[3], hi[3];
    std::fill(lo, lo + 3, std::numeric_limits<float>::infinity());
    std::fill(hi, hi + 3, -std::numeric_limits<float>::infinity());
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const float* p = point(i);
      for (int a = 0; a < 3; ++a) lo[a] = std::min(lo[a], p[a]), hi[a] = std::max(hi[a], p[a]);
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
    const auto octant = [&](const float* p) {
      return (p[0] > c.x ? 1 : 0) | (p[1] > c.y ? 2 : 0) | (p[2] > c.z ? 4 : 0);
    };
    std::array<std::uint32_t, 9> starts{};
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) ++starts[octant(point(i)) + 1];
    for (int o = 0; o < 8; ++o) starts[o + 1] += starts[o];
    std::array<std::uint32_t, 8> next;
    std::copy_n(starts.begin(), 8, next.begin());
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      scratch_[next[octant(point(i))]++] = bins_.order[i];
    }
    std::copy_n(scratch_.begin(), range.count, bins_.order.begin() + range.first);
    for (int o = 7; o >= 0; --o) {
      const std::uint32_t count = starts[o + 1] - starts[o];
      if (count > 0) stack_.push_back({range.first + starts[o], count, levels_.size() - 1});
    }
  }

  std::span<const float> xyz_;
  Pruner pruner_;
  const Tape& tape_;
  PointBins bins_;
  std::vector<std::uint32_t> scratch_;
  std::vector<Instruction> arena_;
  std::vector<Level> levels_;
  std::vector<Range> stack_;
};

}  // namespace

PointBins bin_points(const Tape& tape, std::span<const float> xyz) {
  return Binner(tape, xyz).run();
}

}  // namespace isofield::blobtree
