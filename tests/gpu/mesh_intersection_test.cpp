// Tests with CGAL that meshes do not intersect themselves.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/mesh_check.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/self_intersection.h"
#include "support/shared_files.h"

namespace isofield::gpu_test {
namespace {

// Returns whether the mesh has triangles.
bool expect_no_intersections(const v1::Scene& scene, const engine::MeshRequest& request, const std::string& what) {
  static engine::Mesher mesher(device(), kernels(), workers());
  const auto mesh = mesher.mesh(*resident(scene), request, {});
  EXPECT_TRUE(mesh.ok()) << what << ": " << mesh.status();
  if (!mesh.ok() || mesh->triangles.empty()) return false;
  const test_support::MeshReport report = test_support::check_mesh(mesh->positions, mesh->triangles);
  EXPECT_TRUE(report.sound()) << what << ": " << report.text();
  EXPECT_EQ(report.zero_area, 0u) << what;
  const auto pairs = test_support::self_intersections(mesh->positions, mesh->triangles);
  std::cout << what << ", cell " << request.cell_size << ": " << report.triangles << " triangles, " << pairs.size()
            << " pairs that meet\n";
  EXPECT_TRUE(pairs.empty()) << what << ", cell " << request.cell_size << ": " << pairs.size()
                             << " pairs of triangles meet";
  return true;
}

TEST(MeshIntersections, HaveNoneInTheFigures) {
  for (const char* figure : {"g02_max", "g02_clean", "g02_bernhardt", "g02_functional", "g02_r_union", "g04d_topology",
                             "g14", "g16", "h03", "h08", "h09_wheel"}) {
    const std::ifstream file(test_support::checkout_file(std::string("client/examples/figures/") + figure + ".json"));
    ASSERT_TRUE(file.good()) << figure;
    std::stringstream text;
    text << file.rdbuf();
    const v1::Scene scene = test_support::scene_message(text.str());
    const double iso = resident(scene)->tape().law == operators::Law::kSigned ? 0 : 0.5;
    for (const double cell : {0.11, 0.03}) {
      EXPECT_TRUE(expect_no_intersections(scene, {.cell_size = cell, .iso = iso}, figure)) << figure << " is empty";
    }
  }
}

TEST(MeshIntersections, HaveNoneInRandomScenes) {
  int meshes = 0;
  for (const int nodes : {3, 10, 40, 120}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const v1::Scene scene = test_support::random_scene(50 * nodes + seed, {.nodes = nodes});
      for (const double cell : {0.31, 0.11}) {
        meshes += expect_no_intersections(scene, {.cell_size = cell, .bounds = blobtree::Box{{-2, -2, -2}, {2, 2, 2}}},
                                          absl::StrCat(nodes, " nodes, seed ", seed));
      }
    }
  }
  // Some random scenes cut everything away.
  EXPECT_GE(meshes, 36) << "of 48";
}

}  // namespace
}  // namespace isofield::gpu_test
