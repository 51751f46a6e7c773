// [G]: no lost holes.
#include <gtest/gtest.h>

#include <absl/strings/str_join.h>

#include "gpu/device_field.h"
#include "support/mesh_check.h"
#include "support/paper_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using test_support::Join;
using test_support::soft_segment;

std::int64_t genus(const std::string& nodes, double cell, std::size_t components) {
  const engine::Mesh mesh = DeviceField(test_support::scene_of_nodes("[" + nodes + "]")).mesh(cell);
  const test_support::MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
  EXPECT_TRUE(report.sound()) << report.text();
  std::cout << report.text() << "\n";
  (void)components;
  return report.genus();
}

TEST(PaperTopology, Explore) {
  for (const double side : {1.0, 1.1, 1.2, 1.3}) {
    for (const auto& order : std::vector<std::vector<std::string>>{{"s", "e", "n", "w"}, {"s", "n", "e", "w"}}) {
      for (const Join join : {Join::kMax, Join::kSum, Join::kCamel, Join::kOrganic, Join::kContact}) {
        const double h = side / 2;
        const std::string nodes = absl::StrJoin(
            std::vector<std::string>{soft_segment("s", {-h, -h, 0}, {h, -h, 0}, 1), soft_segment("e", {h, -h, 0}, {h, h, 0}, 1),
                                     soft_segment("n", {h, h, 0}, {-h, h, 0}, 1), soft_segment("w", {-h, h, 0}, {-h, -h, 0}, 1),
                                     test_support::join_node(join, order)},
            ",");
        std::cout << side << " " << absl::StrJoin(order, "") << " " << text(join) << " " << genus(nodes, 0.02, 1) << "\n";
        const reference::Evaluator e(test_support::read_or_die(test_support::scene_of_nodes("[" + nodes + "]")));
        std::cout << "   centre " << e.value({0, 0, 0}) << "\n";
      }
    }
  }
  for (const double R : {0.6, 0.7}) {
    for (const Join join : {Join::kMax, Join::kSum, Join::kCamel, Join::kOrganic, Join::kContact}) {
      const std::string nodes =
          test_support::soft_torus("ring", 0.8, 0.9) + "," + soft_segment("rod", {0, 0, -1.5}, {0, 0, 1.5}, R) + "," +
          test_support::join_node(join, {"ring", "rod"});
      std::cout << "torus axis " << R << " " << text(join) << " " << genus(nodes, 0.03, 1) << "\n";
      const std::string across =
          test_support::soft_torus("ring", 1.05, 1) + "," + soft_segment("rod", {-2, 0, 0}, {2, 0, 0}, R) + "," +
          test_support::join_node(join, {"ring", "rod"});
      std::cout << "torus across " << R << " " << text(join) << " " << genus(across, 0.03, 1) << "\n";
    }
  }
}

}  // namespace
}  // namespace isofield::gpu_test
