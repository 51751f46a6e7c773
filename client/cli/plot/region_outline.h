#pragma once

#include <absl/status/statusor.h>

#include <functional>
#include <vector>

#include "plot/segment.h"

namespace isofield {

// Which of many points lie in a region: not 0 where one does.
using Membership = std::function<absl::StatusOr<std::vector<char>>(const std::vector<Point>& points)>;

// The outline of a region within [low, high] x [low, high], in its coordinates: looked for on a lattice of `cells` a
// side and then found on its edges to 1/4096 of a cell. What is narrower than a cell may be missed.
absl::StatusOr<std::vector<Segment>> region_outline(double low, double high, int cells, const Membership& contains);

}  // namespace isofield
