// The contents of a mesh brick by brick, to compare meshes that were made in different ways.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"
#include "engine/residency/resident_scene.h"

namespace isofield::gpu_test {

struct Place {
  std::uint32_t x, y, z;
  bool operator==(const Place&) const = default;
};
struct InOrder {
  bool operator()(const Place& a, const Place& b) const { return engine::comes_before(a, b); }
};
// The vertices and triangles of one brick.
struct Content {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> corners;
  bool operator==(const Content&) const = default;
};
using Bricks = std::map<Place, Content, InOrder>;

// Puts what `cells` hold in the place of what was known of the same bricks.
void put(const engine::MeshCells& cells, Bricks& bricks);

// The mesh of a mesher that has kept nothing. A failure fails the test.
Bricks bricks_of(const engine::ResidentScene& scene, const engine::MeshRequest& request);

}  // namespace isofield::gpu_test
