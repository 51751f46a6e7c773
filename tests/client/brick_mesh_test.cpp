// Tests that meshes by bricks are joined in the documented order, and that malformed messages are refused.
#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "isofield/mesh.h"
#include "tensor.h"

namespace isofield {
namespace {

using Place = BrickMesh::Place;

// These bits of a corner name the brick whose x, y or z is one less.
constexpr std::uint32_t kBelowX = 1u << 24, kBelowY = 1u << 25, kBelowZ = 1u << 26;

void set_indices(const std::vector<std::uint32_t>& numbers, std::uint64_t columns, v1::Tensor& tensor) {
  tensor.Clear();
  tensor.set_dtype(v1::Tensor::UINT32);
  tensor.add_shape(numbers.size() / columns);
  tensor.add_shape(columns);
  tensor.set_data(numbers.data(), 4 * numbers.size());
}

v1::Tensor places(const std::vector<std::uint32_t>& numbers) {
  v1::Tensor tensor;
  set_indices(numbers, 3, tensor);
  return tensor;
}

// Makes a message as the server does.
class Message {
 public:
  // Vertex i of the brick is at (mark, i, 0), with the normal (0, 0, 1).
  Message& add(const Place& place, std::uint32_t vertices, const std::vector<std::uint32_t>& corners, float mark = 0) {
    table_.insert(table_.end(),
                  {place[0], place[1], place[2], vertices, static_cast<std::uint32_t>(corners.size() / 3)});
    for (std::uint32_t i = 0; i < vertices; ++i) {
      positions_.insert(positions_.end(), {mark, static_cast<float>(i), 0});
      normals_.insert(normals_.end(), {0, 0, 1});
    }
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    return *this;
  }
  v1::MeshBricks bricks(bool with_normals = true) const {
    v1::MeshBricks message;
    set_indices(table_, 5, *message.mutable_bricks());
    set_points(positions_, *message.mutable_positions());
    if (with_normals) set_points(normals_, *message.mutable_normals());
    set_indices(corners_, 3, *message.mutable_corners());
    return message;
  }

 private:
  std::vector<std::uint32_t> table_, corners_;
  std::vector<float> positions_, normals_;
};

// The triangles of the second brick name vertices of the first, which is before it along x.
Message two_bricks() {
  Message message;
  message.add({4, 5, 6}, 3, {0, 1, 2}, 1).add({5, 5, 6}, 2, {0, 1, kBelowX | 2, 1, kBelowX | 0, kBelowX | 2}, 2);
  return message;
}

TEST(BrickMesh, NumbersVerticesThroughTheBricks) {
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(two_bricks().bricks()).ok());
  EXPECT_EQ(bricks.brick_count(), 2u);
  EXPECT_EQ(bricks.vertex_count(), 5u);
  EXPECT_EQ(bricks.triangle_count(), 3u);
  const auto mesh = bricks.join();
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  EXPECT_EQ(mesh->positions, (std::vector<float>{1, 0, 0, 1, 1, 0, 1, 2, 0, 2, 0, 0, 2, 1, 0}));
  EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2, 4, 0, 2}));
  EXPECT_EQ(mesh->summary.vertices(), 5u);
  EXPECT_EQ(mesh->summary.triangles(), 3u);
}

TEST(BrickMesh, CornersNameAllSevenBricksBefore) {
  Message message;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < 8; ++i) {
    // The corners of the last brick name vertices of the eight bricks of a cube: the cleared bits of i are the axes
    // along which the named brick is one less.
    const Place place{8 + (i & 1), 8 + (i >> 1 & 1), 8 + (i >> 2)};
    for (int repeat = 0; repeat < 3; ++repeat) corners.push_back((~i & 7) << 24);
    message.add(place, 1, i == 7 ? corners : std::vector<std::uint32_t>(), static_cast<float>(i));
  }
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(message.bricks()).ok());
  const auto mesh = bricks.join();
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  ASSERT_EQ(mesh->triangle_count(), 8u);
  // Within a layer and a cube of two, the Morton code is the octant.
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(mesh->triangles[3 * i], i);
}

TEST(BrickMesh, JoinsInOrderOfPlace) {
  // The order is the contract's: floor(z / 8), then the interleaved bits.
  const auto order = [](const Place& p) {
    std::uint64_t morton = 0;
    for (int bit = 0; bit < 21; ++bit) {
      for (int axis = 0; axis < 3; ++axis) morton |= std::uint64_t{p[axis] >> bit & 1} << (3 * bit + axis);
    }
    return std::tuple(p[2] / 8, morton);
  };
  std::mt19937 random(5);
  std::map<std::tuple<std::uint32_t, std::uint64_t>, float> expected;
  BrickMesh bricks;
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t extent = i % 2 ? 24 : 1u << 20;
    const Place place{static_cast<std::uint32_t>(random()) % extent, static_cast<std::uint32_t>(random()) % extent,
                      static_cast<std::uint32_t>(random()) % extent};
    expected[order(place)] = static_cast<float>(i);  // the last one stays
    ASSERT_TRUE(bricks.apply(Message().add(place, 1, {}, static_cast<float>(i)).bricks()).ok());
  }
  const auto mesh = bricks.join();
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  ASSERT_EQ(mesh->vertex_count(), expected.size());
  std::size_t vertex = 0;
  for (const auto& [place, mark] : expected) ASSERT_EQ(mesh->positions[3 * vertex++], mark);
}

TEST(BrickMesh, FollowsWhatComesAndGoes) {
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(two_bricks().bricks()).ok());
  ASSERT_TRUE(bricks.apply(Message().add({5, 5, 6}, 1, {0, kBelowX, kBelowX | 1}, 7).bricks()).ok());
  EXPECT_EQ(bricks.vertex_count(), 4u);
  EXPECT_EQ(bricks.join()->triangles, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1}));
  ASSERT_TRUE(bricks.remove(places({5, 5, 6})).ok());
  EXPECT_EQ(bricks.join()->triangles, (std::vector<std::uint32_t>{0, 1, 2}));
  bricks.clear();
  EXPECT_EQ(bricks.brick_count(), 0u);
  EXPECT_EQ(bricks.vertex_count(), 0u);
  EXPECT_EQ(bricks.join()->vertex_count(), 0u);
}

TEST(BrickMesh, PartsJoinToTheWhole) {
  BrickMesh whole, first, second;
  ASSERT_TRUE(whole.apply(two_bricks().bricks()).ok());
  ASSERT_TRUE(first.apply(Message().add({4, 5, 6}, 3, {0, 1, 2}, 1).bricks()).ok());
  ASSERT_TRUE(
      second.apply(Message().add({5, 5, 6}, 2, {0, 1, kBelowX | 2, 1, kBelowX | 0, kBelowX | 2}, 2).bricks()).ok());
  EXPECT_EQ(second.join().status().code(), absl::StatusCode::kInternal) << "its neighbour is missing";
  second.add(first);
  EXPECT_EQ(second.join()->triangles, whole.join()->triangles);
  EXPECT_EQ(second.join()->positions, whole.join()->positions);
}

TEST(BrickMesh, NormalsMayBeAbsentFromAll) {
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(two_bricks().bricks(false)).ok());
  EXPECT_TRUE(bricks.join()->normals.empty());
  ASSERT_TRUE(bricks.apply(Message().add({9, 9, 9}, 1, {}).bricks()).ok());
  const auto mixed = bricks.join();
  EXPECT_EQ(mixed.status().code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(absl::StrContains(mixed.status().message(), "1 of 6 vertices have normals")) << mixed.status();
}

TEST(BrickMesh, EmptyMessagesChangeNothing) {
  BrickMesh bricks;
  EXPECT_TRUE(bricks.apply({}).ok());
  EXPECT_TRUE(bricks.apply(Message().bricks()).ok());
  EXPECT_TRUE(bricks.remove(places({})).ok());
  EXPECT_EQ(bricks.brick_count(), 0u);
}

// Checks that the message is refused, and that nothing of it is kept.
void expect_malformed(const v1::MeshBricks& message, const std::string& part) {
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(Message().add({0, 0, 0}, 1, {}).bricks()).ok());
  const absl::Status status = bricks.apply(message);
  EXPECT_EQ(status.code(), absl::StatusCode::kInternal) << status;
  EXPECT_TRUE(absl::StrContains(status.message(), part)) << "'" << part << "' in: " << status;
  EXPECT_EQ(bricks.brick_count(), 1u);
  EXPECT_EQ(bricks.vertex_count(), 1u);
}

TEST(BrickMesh, RefusesArraysThatDoNotFitTheTable) {
  const v1::MeshBricks good = two_bricks().bricks();
  v1::MeshBricks bad = good;
  bad.clear_positions();
  expect_malformed(bad, "5 vertices and 3 triangles, but sent 0 positions");
  bad = good;
  set_points(std::vector<float>(12), *bad.mutable_normals());
  expect_malformed(bad, "4 normals");
  bad = good;
  set_indices({0, 1, 2}, 3, *bad.mutable_corners());
  expect_malformed(bad, "1 triangles");
  bad = good;
  bad.clear_bricks();
  expect_malformed(bad, "0 bricks");
  bad = good;
  set_indices({1, 2, 3, ~0u, ~0u, 1, 2, 4, ~0u, ~0u}, 5, *bad.mutable_bricks());
  expect_malformed(bad, "8589934590 vertices");
}

TEST(BrickMesh, RefusesMalformedArrays) {
  const v1::MeshBricks good = two_bricks().bricks();
  v1::MeshBricks bad = good;
  bad.mutable_bricks()->mutable_data()->pop_back();
  expect_malformed(bad, "malformed array");
  bad = good;
  bad.mutable_bricks()->set_shape(1, 3);
  expect_malformed(bad, "malformed array");
  bad = good;
  bad.mutable_corners()->set_dtype(v1::Tensor::FLOAT32);
  expect_malformed(bad, "malformed array");
  bad = good;
  bad.mutable_positions()->clear_shape();
  expect_malformed(bad, "malformed array");
}

TEST(BrickMesh, RefusesCornersOfVerticesThatAreNotThere) {
  expect_malformed(Message().add({1, 1, 1}, 2, {0, 1, 2}).bricks(), "brick (1, 1, 1), which has 2 vertices");
  // These bits have no meaning.
  expect_malformed(Message().add({1, 1, 1}, 2, {0, 1, 1u << 27}).bricks(), "no such vertex");
  expect_malformed(Message().add({1, 1, 1}, 2, {0, 1, 1u << 31}).bricks(), "no such vertex");
  // These corners name bricks before the lattice's first brick.
  expect_malformed(Message().add({0, 1, 1}, 2, {0, 1, kBelowX}).bricks(), "no such vertex");
  expect_malformed(Message().add({1, 0, 1}, 2, {0, 1, kBelowY}).bricks(), "no such vertex");
  expect_malformed(Message().add({1, 1, 0}, 2, {0, 1, kBelowZ}).bricks(), "no such vertex");
  // Only joining can tell whether a vertex of another brick exists.
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(Message().add({4, 5, 6}, 3, {}).add({5, 5, 6}, 1, {0, 0, kBelowX | 3}).bricks()).ok());
  EXPECT_EQ(bricks.join().status().code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(absl::StrContains(bricks.join().status().message(), "vertex 3 of a neighbouring brick that has 3"))
      << bricks.join().status();
}

TEST(BrickMesh, RefusesToRemoveWhatIsNotThere) {
  BrickMesh bricks;
  ASSERT_TRUE(bricks.apply(two_bricks().bricks()).ok());
  const absl::Status status = bricks.remove(places({4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(status.code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(absl::StrContains(status.message(), "brick (1, 2, 3)")) << status;
  EXPECT_EQ(bricks.remove(v1::Tensor()).code(), absl::StatusCode::kInternal);
  EXPECT_EQ(bricks.brick_count(), 2u);
}

}  // namespace
}  // namespace isofield
