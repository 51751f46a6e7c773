#include <absl/container/flat_hash_map.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <bit>
#include <utility>

#include "isofield/mesh.h"
#include "tensor.h"

namespace isofield {
namespace {

using Place = BrickMesh::Place;

constexpr std::uint32_t kLayerBricks = 8;
// A corner holds the number of the vertex in its brick and, above these bits, three bits that are set where the x, y or
// z of that brick is one less than that of the brick of the triangle.
constexpr int kBelowShift = 24;
constexpr std::uint32_t kVertexBits = (1u << kBelowShift) - 1, kBelowBits = 7;

std::string text(const Place& place) {
  return absl::StrCat("brick (", absl::StrJoin(place, ", "), ")");
}

// Checks a corner of a triangle of the brick at `place`, which has `vertices` vertices. INTERNAL: it cannot name a
// vertex.
absl::Status check_corner(std::uint32_t corner, const Place& place, std::uint32_t vertices) {
  const std::uint32_t below = corner >> kBelowShift, vertex = corner & kVertexBits;
  bool fits = below <= kBelowBits && (below != 0 || vertex < vertices);
  for (int axis = 0; axis < 3; ++axis) fits = fits && (place[axis] > 0 || (below >> axis & 1) == 0);
  if (fits) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("the server sent a corner ", corner, " in ", text(place), ", which has ",
                                          vertices, " vertices: there is no such vertex"));
}

template <class T>
std::vector<T> rows(const std::vector<T>& all, std::size_t first, std::size_t count) {
  return {all.begin() + 3 * first, all.begin() + 3 * (first + count)};
}

template <class T>
void append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

bool BrickMesh::InOrder::operator()(const Place& a, const Place& b) const {
  if (a[2] / kLayerBricks != b[2] / kLayerBricks) return a[2] < b[2];
  // The highest bit that differs decides. Where several axes differ in this bit, z counts before y, and y before x.
  int axis = 2;
  for (const int i : {1, 0}) {
    if (std::bit_width(a[i] ^ b[i]) > std::bit_width(a[axis] ^ b[axis])) axis = i;
  }
  return a[axis] < b[axis];
}

absl::Status BrickMesh::apply(const v1::MeshBricks& message) {
  std::vector<std::uint32_t> table, corners;
  std::vector<float> positions, normals;
  absl::Status status;
  if (message.has_bricks()) status.Update(append_indices(message.bricks(), 5, table));
  if (message.has_positions()) status.Update(append_floats(message.positions(), 3, positions));
  if (message.has_normals()) status.Update(append_floats(message.normals(), 3, normals));
  if (message.has_corners()) status.Update(append_indices(message.corners(), 3, corners));
  if (!status.ok()) return status;

  std::uint64_t vertices = 0, triangles = 0;
  for (std::size_t row = 0; row < table.size(); row += 5) {
    vertices += table[row + 3];
    triangles += table[row + 4];
  }
  if (positions.size() != 3 * vertices || corners.size() != 3 * triangles ||
      (message.has_normals() && normals.size() != positions.size())) {
    return absl::InternalError(absl::StrCat("the server announced ", table.size() / 5, " bricks of ", vertices,
                                            " vertices and ", triangles, " triangles, but sent ", positions.size() / 3,
                                            " positions, ", normals.size() / 3, " normals and ", corners.size() / 3,
                                            " triangles"));
  }
  std::size_t corner = 0;
  for (std::size_t row = 0; row < table.size(); row += 5) {
    for (const std::size_t end = corner + 3 * std::size_t{table[row + 4]}; corner < end; ++corner) {
      status = check_corner(corners[corner], {table[row], table[row + 1], table[row + 2]}, table[row + 3]);
      if (!status.ok()) return status;
    }
  }

  std::size_t vertex = 0, triangle = 0;
  for (std::size_t row = 0; row < table.size(); row += 5) {
    Brick brick;
    brick.positions = rows(positions, vertex, table[row + 3]);
    if (!normals.empty()) brick.normals = rows(normals, vertex, table[row + 3]);
    brick.corners = rows(corners, triangle, table[row + 4]);
    vertex += table[row + 3];
    triangle += table[row + 4];
    put({table[row], table[row + 1], table[row + 2]}, std::move(brick));
  }
  return absl::OkStatus();
}

void BrickMesh::add(const BrickMesh& part) {
  for (const auto& [place, brick] : part.bricks_) put(place, brick);
}

absl::Status BrickMesh::remove(const v1::Tensor& places) {
  std::vector<std::uint32_t> numbers;
  if (auto status = append_indices(places, 3, numbers); !status.ok()) return status;
  std::vector<Place> removed;
  for (std::size_t i = 0; i < numbers.size(); i += 3) removed.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  for (const Place& place : removed) {
    if (!bricks_.contains(place)) {
      return absl::InternalError(absl::StrCat("the server removed ", text(place), ", which is not there"));
    }
  }
  for (const Place& place : removed) forget(place);
  return absl::OkStatus();
}

void BrickMesh::clear() {
  *this = BrickMesh();
}

absl::StatusOr<Mesh> BrickMesh::join() const {
  struct Numbers {
    std::uint32_t first, count;
  };
  absl::flat_hash_map<Place, Numbers> numbers;
  numbers.reserve(bricks_.size());
  Mesh mesh;
  mesh.positions.reserve(3 * vertices_);
  mesh.triangles.reserve(3 * triangles_);
  for (const auto& [place, brick] : bricks_) {
    const Numbers own{static_cast<std::uint32_t>(mesh.vertex_count()),
                      static_cast<std::uint32_t>(brick.positions.size() / 3)};
    numbers.emplace(place, own);
    append(brick.positions, mesh.positions);
    append(brick.normals, mesh.normals);
    // Bricks with smaller coordinates come earlier in the order, so that their vertices are numbered already.
    std::array<Numbers, kBelowBits + 1> named{own};
    for (std::uint32_t below = 1; below <= kBelowBits; ++below) {
      const auto found = numbers.find({place[0] - (below & 1), place[1] - (below >> 1 & 1), place[2] - (below >> 2)});
      named[below] = found == numbers.end() ? Numbers{0, 0} : found->second;
    }
    for (const std::uint32_t corner : brick.corners) {
      const Numbers& n = named[corner >> kBelowShift];
      if ((corner & kVertexBits) >= n.count) {
        return absl::InternalError(absl::StrCat("corner ", corner, " in ", text(place), " names vertex ",
                                                corner & kVertexBits, " of a neighbouring brick that has ", n.count,
                                                ": it has not been sent, or the part that holds it is missing"));
      }
      mesh.triangles.push_back(n.first + (corner & kVertexBits));
    }
  }
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    return absl::InternalError(absl::StrCat(mesh.normals.size() / 3, " of ", mesh.vertex_count(),
                                            " vertices have normals; expected all or none"));
  }
  mesh.summary.set_vertices(mesh.vertex_count());
  mesh.summary.set_triangles(mesh.triangle_count());
  return mesh;
}

void BrickMesh::put(const Place& place, Brick brick) {
  forget(place);
  vertices_ += brick.positions.size() / 3;
  triangles_ += brick.corners.size() / 3;
  bricks_.emplace(place, std::move(brick));
}

void BrickMesh::forget(const Place& place) {
  const auto found = bricks_.find(place);
  if (found == bricks_.end()) return;
  vertices_ -= found->second.positions.size() / 3;
  triangles_ -= found->second.corners.size() / 3;
  bricks_.erase(found);
}

}  // namespace isofield
