#include "rpc/grid_parts.h"

#include <algorithm>

namespace isofield::rpc {

std::vector<GridPart> grid_parts(const std::array<std::uint64_t, 3>& counts, std::uint64_t most) {
  const auto [nx, ny, nz] = counts;
  // These are the points of a part along each axis. If a part has fewer than the grid along one axis, it has one point
  // along all later axes.
  const std::uint64_t columns = std::min(nx, most);
  const std::uint64_t rows = columns < nx ? 1 : std::min(ny, most / nx);
  const std::uint64_t layers = columns < nx || rows < ny ? 1 : std::min(nz, most / (nx * ny));
  std::vector<GridPart> parts;
  for (std::uint64_t z = 0; z < nz; z += layers) {
    for (std::uint64_t y = 0; y < ny; y += rows) {
      for (std::uint64_t x = 0; x < nx; x += columns) {
        parts.push_back({{x, y, z}, {std::min(columns, nx - x), std::min(rows, ny - y), std::min(layers, nz - z)}});
      }
    }
  }
  return parts;
}

}  // namespace isofield::rpc
