#pragma once

#include <absl/status/statusor.h>

#include <functional>
#include <vector>

#include "plot/segment.h"

namespace isofield {

// Tells which of many points lie in a region: the result has a number for each point, which is not 0 if the point does.
using Membership = std::function<absl::StatusOr<std::vector<char>>(const std::vector<Point>& points)>;

// Finds the outline of a region within [low, high] x [low, high], in the same coordinates. It asks for the points of a
// lattice with `cells` cells a side, and then locates the outline on the lattice's edges to 1/4096 of a cell. Parts of
// the region narrower than a cell may be missed. Errors are those of `contains`.
absl::StatusOr<std::vector<Segment>> region_outline(double low, double high, int cells, const Membership& contains);

}  // namespace isofield
