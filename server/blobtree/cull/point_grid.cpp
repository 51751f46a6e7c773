#include "blobtree/cull/point_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "blobtree/tape/extent.h"

namespace isofield::blobtree {
namespace {

// The number of bricks along the longest edge makes for a few bricks for each primitive. More bricks have shorter
// tapes, but fewer points each: measured with 1,000 spheres, twice as many along an edge take a fifth longer.
constexpr double kBricksAlongPerRoot = 1.6, kLeastAlong = 16, kMostAlong = 64;
// The boxes that tapes are pruned for overlap by this part of a brick, because float32 finds a point's brick within
// this.
constexpr double kRoom = 1e-3;
// A part has enough points to be worth a thread's while, and there are enough parts for several threads to share
// evenly.
constexpr std::size_t kLeastPart = 1u << 13, kMostParts = 8;

}  // namespace

absl::StatusOr<PointGrid> PointGrid::make(const Tape& tape, BrickList& bricks, const std::function<bool()>& cancelled) {
  const Box& box = tape.support;
  const double longest = box.empty() ? 0 : longest_edge(box);
  // Outside of the grid the field is taken to be 0, which is true of positive fields alone.
  if (tape.law != operators::Law::kPositive || !box.is_bounded() || !(longest > 0)) {
    return absl::FailedPreconditionError("the scene's field is signed, or its support is empty or has no end");
  }
  const double along =
      std::clamp(kBricksAlongPerRoot * std::cbrt(static_cast<double>(tape.leaves.size())), kLeastAlong, kMostAlong);
  // The step is a float32 number, because sort() computes in float32.
  const auto step = static_cast<double>(static_cast<float>(longest / along * 1.0001));
  PointGrid grid;
  grid.per_step_ = static_cast<float>(1 / step);
  CullRequest request{
      .keep = Keep::kSupport, .margin = kRoom * step, .max_instructions = kMostInstructions, .cancelled = cancelled};
  request.lattice.spacing = dvec3{step, step, step} * (1.0 / kBrickCells);
  const auto set_axis = [&](int axis, double low, double high, double& origin) {
    grid.origin_[axis] = std::nextafter(static_cast<float>(low), -std::numeric_limits<float>::infinity());
    origin = static_cast<double>(grid.origin_[axis]);
    grid.counts_[axis] = static_cast<std::uint32_t>((high - origin) / step) + 1;
    request.lattice.cells[axis] = grid.counts_[axis] * kBrickCells;
  };
  set_axis(0, box.min.x, box.max.x, request.lattice.origin.x);
  set_axis(1, box.min.y, box.max.y, request.lattice.origin.y);
  set_axis(2, box.min.z, box.max.z, request.lattice.origin.z);
  absl::StatusOr<BrickList> list = cull(tape, request);
  if (!list.ok()) return list.status();
  bricks = *std::move(list);
  grid.bricks_ = static_cast<std::uint32_t>(bricks.bricks.size());
  grid.places_.assign(std::size_t{grid.counts_[0]} * grid.counts_[1] * grid.counts_[2], grid.bricks_);
  for (std::uint32_t b = 0; b < grid.bricks_; ++b) {
    const Brick& at = bricks.bricks[b];
    grid.places_[at.x + std::size_t{grid.counts_[0]} * (at.y + std::size_t{grid.counts_[1]} * at.z)] = b;
  }
  return grid;
}

std::uint32_t PointGrid::brick_at(const float* p) const {
  std::uint32_t at[3];
  bool is_within = true;
  for (int a = 0; a < 3; ++a) {
    const float t = (p[a] - origin_[a]) * per_step_;
    is_within = is_within && t >= 0 && t < static_cast<float>(counts_[a]);
    at[a] = is_within ? static_cast<std::uint32_t>(t) : 0;
  }
  if (!is_within) return bricks_;
  return places_[at[0] + std::size_t{counts_[0]} * (at[1] + std::size_t{counts_[1]} * at[2])];
}

PointGrid::Sorted PointGrid::sort(std::span<const float> xyz, const base::ForEach& for_each) const {
  const std::size_t count = xyz.size() / 3, bins = std::size_t{bricks_} + 1;
  const std::size_t parts = for_each ? std::clamp<std::size_t>(count / kLeastPart, 1, kMostParts) : 1;
  const auto in_parts = [&](const auto& work) {
    const auto part = [&](std::size_t i) { work(i, count * i / parts, count * (i + 1) / parts); };
    if (parts > 1) return for_each(parts, part);
    part(0);
  };
  const auto bin_of = std::make_unique_for_overwrite<std::uint32_t[]>(count);
  // places[part] first has the number of the part's points in each bin, and then the place of the next one of them.
  std::vector<std::vector<std::uint32_t>> places(parts);
  in_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    places[part].assign(bins, 0);
    for (std::size_t i = begin; i < end; ++i) ++places[part][bin_of[i] = brick_at(&xyz[3 * i])];
  });
  Sorted sorted;
  sorted.starts.reserve(bins + 1);
  std::uint32_t next = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    sorted.starts.push_back(next);
    for (auto& of_part : places) next += std::exchange(of_part[b], next);
  }
  sorted.starts.push_back(next);
  sorted.points = std::make_unique_for_overwrite<PlacedPoint[]>(count);
  in_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float* p = &xyz[3 * i];
      sorted.points[places[part][bin_of[i]]++] = {p[0], p[1], p[2], static_cast<std::uint32_t>(i)};
    }
  });
  return sorted;
}

}  // namespace isofield::blobtree
