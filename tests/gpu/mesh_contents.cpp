#include "gpu/mesh_contents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"

namespace isofield::gpu_test {

using engine::MeshBrick;
using engine::MeshCells;

void put(const MeshCells& cells, Bricks& bricks) {
  std::size_t vertex = 0, triangle = 0;
  for (const MeshBrick& b : cells.bricks) {
    const auto part = [](const auto& from, std::size_t first, std::size_t count) {
      return std::decay_t<decltype(from)>(from.begin() + 3 * first, from.begin() + 3 * (first + count));
    };
    bricks[{b.x, b.y, b.z}] = {part(cells.positions, vertex, b.vertices), part(cells.normals, vertex, b.vertices),
                               part(cells.corners, triangle, b.triangles)};
    vertex += b.vertices;
    triangle += b.triangles;
  }
}

Bricks bricks_of(const engine::ResidentScene& scene, const engine::MeshRequest& request) {
  engine::Mesher mesher(device(), kernels(), workers());
  Bricks bricks;
  const absl::Status s = mesher.cells(scene, request, {}, [&](const MeshCells& cells) {
    EXPECT_TRUE(std::is_sorted(cells.bricks.begin(), cells.bricks.end(), engine::comes_before<MeshBrick, MeshBrick>));
    put(cells, bricks);
    return absl::OkStatus();
  });
  EXPECT_TRUE(s.ok()) << s;
  return bricks;
}

}  // namespace isofield::gpu_test
