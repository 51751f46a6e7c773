#include "engine/mesh/cell_size.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/mesh/mesh_lattice.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::engine {
namespace {

blobtree::Tape tape_of(const std::string& nodes) {
  return test_support::compile_or_die(test_support::read_or_die(test_support::scene_of_nodes(nodes)));
}

constexpr char kSphere[] = R"({"sphere": {"radius": 1, "range": 0.5}})";

// Makes a thousand rods in a box: thin parts in a wide scene.
blobtree::Tape rods() {
  test_support::Random random(5);
  std::string nodes, names;
  for (int i = 0; i < 1000; ++i) {
    const auto p = random.point(0, 100), d = random.point(-8, 8);
    absl::StrAppend(&nodes, R"({"segment": {"a": [)", p.x, ",", p.y, ",", p.z, R"(], "b": [)", p.x + d.x, ",",
                    p.y + d.y, ",", p.z + d.z, R"(], "radius_a": 0.4, "radius_b": 0.4, "range": 0.4}},)");
    absl::StrAppend(&names, i == 0 ? "" : ",", "\"#", i, "\"");
  }
  return tape_of(absl::StrCat(nodes, R"({"max": {"children": [)", names, "]}}"));
}

double thickness(const std::string& node, double iso = 0.5) {
  const auto thin = too_thin(tape_of(node), {.cell_size = 1e6, .iso = iso});
  return thin ? thin->thickness : 0;
}

TEST(CellSize, EveryPrimitiveHasAThickness) {
  EXPECT_DOUBLE_EQ(thickness(R"({"sphere": {"radius": 3, "range": 1}})"), 6);
  EXPECT_DOUBLE_EQ(
      thickness(R"({"segment": {"a": [0, 0, 0], "b": [9, 0, 0], "radius_a": 2, "radius_b": 0.5, "range": 1}})"), 1);
  // The smaller end lies inside of the larger one.
  EXPECT_DOUBLE_EQ(
      thickness(R"({"segment": {"a": [0, 0, 0], "b": [1, 0, 0], "radius_a": 2, "radius_b": 0.5, "range": 1}})"), 4);
  EXPECT_DOUBLE_EQ(thickness(R"({"box": {"half_size": [2, 0.25, 1.5], "range": 1}})"), 0.5);
  EXPECT_DOUBLE_EQ(thickness(R"({"torus": {"major_radius": 4, "minor_radius": 0.25, "range": 1}})"), 0.5);
  EXPECT_DOUBLE_EQ(thickness(R"({"ellipsoid": {"semi_axes": [4, 0.5, 3], "range": 1}})"), 1);
}

TEST(CellSize, APrimitiveIsAsThickAsItIsWhereTheFieldIsIso) {
  // w(r) = (1 - r^2)^3 = 0.729 at r^2 = 0.1.
  const double r0 = std::sqrt(1 - std::cbrt(0.5)), inward = (r0 - std::sqrt(0.1)) / (1 - r0);
  EXPECT_NEAR(thickness(R"({"sphere": {"radius": 3, "range": 1}})", 0.729), 6 - 2 * inward, 1e-9);
  // A sphere without a surface at that iso value is not in the mesh, so it is not too thin.
  EXPECT_EQ(thickness(R"({"sphere": {"radius": 0.1, "range": 1}})", 0.729), 0);
}

TEST(CellSize, TooThinIsWhatTheCellIsCoarserThan) {
  const blobtree::Tape tape = tape_of(R"(
    {"sphere": {"radius": 1, "range": 1}}, {"sphere": {"center": [5, 0, 0], "radius": 0.25, "range": 1}},
    {"sphere": {"center": [9, 0, 0], "radius": 0.5, "range": 1}}, {"sum": {"children": ["#0", "#1", "#2"]}})");
  EXPECT_FALSE(too_thin(tape, {.cell_size = 0.288}));
  const auto one = too_thin(tape, {.cell_size = 0.29});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->node, 1u);
  EXPECT_EQ(one->primitives, 1u);
  EXPECT_DOUBLE_EQ(one->thickness, 0.5);
  EXPECT_NEAR(one->cell_size, 0.5 / std::sqrt(3), 1e-5);
  EXPECT_EQ(too_thin(tape, {.cell_size = 0.6})->primitives, 2u);
  // Parts outside of the bounds do not matter.
  MeshRequest bounded{.cell_size = 0.6, .bounds = blobtree::Box{{-2, -2, -2}, {3, 2, 2}}};
  EXPECT_FALSE(too_thin(tape, bounded));
}

TEST(CellSize, IsTheThinnestPrimitivesRadiusOrWhatIsAdmitted) {
  const blobtree::Tape sphere = tape_of(kSphere);
  EXPECT_DOUBLE_EQ(automatic_cell_size(sphere, {}).value(), 3.0 / kAutomaticCellsAlong * (1 + 1e-6));
  const blobtree::Tape wide = rods();
  EXPECT_DOUBLE_EQ(automatic_cell_size(wide, {}).value(), 0.4);
  // No lattice can follow this primitive, so the cells use most of what is admitted.
  const blobtree::Tape hair = tape_of(R"(
    {"sphere": {"radius": 1, "range": 0.5}}, {"sphere": {"center": [1, 0, 0], "radius": 1e-9, "range": 0.5}},
    {"sum": {"children": ["#0", "#1"]}})");
  for (const std::uint64_t cells : {std::uint64_t{20'000}, std::uint64_t{1} << 22}) {
    MeshRequest request{.max_cells = cells};
    request.cell_size = automatic_cell_size(hair, request).value();
    const auto found = surface_bricks(hair, request, std::nullopt, cells / blobtree::kCellsPerBrick, {});
    ASSERT_TRUE(found.ok()) << found.status();
    EXPECT_GT(found->list.bricks.size(), 0.8 * static_cast<double>(cells / blobtree::kCellsPerBrick));
  }
}

struct Refusal {
  absl::Status status;
  std::uint64_t visited = 0;  // cells that culling has visited, rounded to 1,024
};
Refusal refuse(const blobtree::Tape& tape, const MeshRequest& request) {
  Refusal r;
  const auto found = surface_bricks(tape, request, std::nullopt, request.max_cells / blobtree::kCellsPerBrick, [&] {
    r.visited += 1024;
    return false;
  });
  r.status = found.status();
  return r;
}

double last_number(const absl::Status& status) {
  const std::string text(status.message());
  return std::stod(text.substr(text.rfind(' ')));
}

TEST(CellSize, ARefusalCostsNextToNothing) {
  for (const blobtree::Tape& tape : {tape_of(kSphere), rods()}) {
    for (const double cell : {5e-4, 1e-5, 1e-30, 1e-300}) {
      SCOPED_TRACE(cell);
      MeshRequest request{.cell_size = cell};
      const Refusal refused = refuse(tape, request);
      ASSERT_EQ(refused.status.code(), absl::StatusCode::kResourceExhausted) << refused.status;
      // Culling the half a million bricks that are admitted visits five times as many cells.
      EXPECT_LE(refused.visited, 300'000u) << refused.status;
      EXPECT_TRUE(
          absl::StartsWith(refused.status.message(), absl::StrCat("cell_size = ", cell, " takes more than the ")))
          << refused.status;
      EXPECT_TRUE(absl::StrContains(refused.status.message(),
                                    cell < least_cell_size(tape, request) ? "along an axis" : "in all"))
          << refused.status;
      // The size that the message states fits, and half of it does not.
      request.cell_size = last_number(refused.status);
      EXPECT_TRUE(refuse(tape, request).status.ok()) << refused.status;
      request.cell_size /= 2;
      EXPECT_FALSE(refuse(tape, request).status.ok()) << refused.status;
    }
  }
}

TEST(CellSize, ARefusalSpeaksOfTheResolutionWhereOneWasStated) {
  const blobtree::Tape tape = tape_of(kSphere);
  const auto at = [](std::uint32_t resolution) {
    return MeshRequest{.cell_size = 3.0 / resolution, .resolution = resolution, .max_cells = 100'000};
  };
  const absl::Status refused = refuse(tape, at(100'000)).status;
  ASSERT_EQ(refused.code(), absl::StatusCode::kResourceExhausted) << refused;
  EXPECT_TRUE(absl::StartsWith(refused.message(), "resolution = 100000 takes more than the ")) << refused;
  EXPECT_TRUE(absl::StrContains(refused.message(), "largest resolution that fits is ")) << refused;
  EXPECT_FALSE(absl::StrContains(refused.message(), "cell_size")) << refused;
  const auto fits = static_cast<std::uint32_t>(last_number(refused));
  EXPECT_TRUE(refuse(tape, at(fits)).status.ok()) << refused;
  EXPECT_FALSE(refuse(tape, at(fits * 11 / 10)).status.ok()) << refused;
}

TEST(CellSize, APartThatIsTooLargeIsToBeAskedForInSmallerOnes) {
  const blobtree::Tape tape = tape_of(kSphere);
  const MeshRequest request{.cell_size = 0.01, .max_cells = 64'000};
  const blobtree::BrickSet all(blobtree::BrickBox{{0, 0, 0}, {1000, 1000, 1000}});
  const auto found = surface_bricks(tape, request, all, 1000, {});
  ASSERT_EQ(found.status().code(), absl::StatusCode::kResourceExhausted) << found.status();
  EXPECT_TRUE(absl::StrContains(found.status().message(), "fewer bricks")) << found.status();
}

}  // namespace
}  // namespace isofield::engine
