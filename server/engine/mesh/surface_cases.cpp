#include "engine/mesh/surface_cases.h"

#include <numeric>
#include <utility>
#include <vector>

namespace isofield::engine {
namespace {

int next(int axis) {
  return (axis + 1) % 3;
}

int edge_between(int a, int b) {
  const int low = a < b ? a : b, axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  const int u = low >> next(axis) & 1, v = low >> next(next(axis)) & 1;
  return 4 * axis + u + 2 * v;
}

// Returns the corners of a face in the order around it.
std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, base = (face & 1) << axis;
  const int u = 1 << next(axis), v = 1 << next(next(axis));
  return {base, base | u, base | u | v, base | v};
}

// Returns the segments in which the surface meets a face, each by the two edges at its ends.
std::vector<std::pair<int, int>> face_segments(int inside, int face, bool joins_inside) {
  const std::array<int, 4> corner = face_corners(face);
  std::array<bool, 4> in;
  std::array<int, 4> edge;  // edge[i] leads from corner i to corner i + 1
  std::vector<int> crossed;
  for (int i = 0; i < 4; ++i) in[i] = inside >> corner[i] & 1;
  for (int i = 0; i < 4; ++i) {
    edge[i] = edge_between(corner[i], corner[(i + 1) % 4]);
    if (in[i] != in[(i + 1) % 4]) crossed.push_back(edge[i]);
  }
  if (crossed.size() == 2) return {{crossed[0], crossed[1]}};
  if (crossed.size() < 4) return {};
  // The face is ambiguous. Each segment cuts off one corner: an inside one or, if the inside ones are joined, an
  // outside one.
  std::vector<std::pair<int, int>> segments;
  for (int i = 0; i < 4; ++i) {
    if (in[i] != joins_inside) segments.emplace_back(edge[(i + 3) % 4], edge[i]);
  }
  return segments;
}

SurfaceCase make_case(int inside, int joined_face) {
  std::array<int, 12> parent;
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e];
    return e;
  };
  std::array<bool, 12> crossed{};
  for (int face = 0; face < 6; ++face) {
    for (const auto& [a, b] : face_segments(inside, face, face == joined_face)) {
      crossed[a] = crossed[b] = true;
      parent[root(a)] = root(b);
    }
  }
  SurfaceCase result;
  std::array<int, 12> patch_of_root;
  patch_of_root.fill(-1);
  for (int e = 0; e < 12; ++e) {
    if (!crossed[e]) continue;
    int& patch = patch_of_root[root(e)];
    if (patch < 0) patch = result.patches++;
    result.patch_of_edge[e] = static_cast<std::uint8_t>(patch);
    result.edges[patch] = static_cast<std::uint16_t>(result.edges[patch] | 1 << e);
  }
  for (int face = 0; face < 6; ++face) {
    const auto segments = face_segments(inside, face, face == joined_face);
    if (segments.size() == 2 && result.patch_of_edge[segments[0].first] == result.patch_of_edge[segments[1].first]) {
      result.doubtful_face = face;
    }
  }
  return result;
}

}  // namespace

std::array<std::uint32_t, 4> SurfaceCase::packed() const {
  std::uint32_t of_edges = 0;
  for (int e = 0; e < 12; ++e) of_edges |= std::uint32_t{patch_of_edge[e]} << (2 * e);
  return {of_edges | static_cast<std::uint32_t>(patches) << 24 | static_cast<std::uint32_t>(doubtful_face + 1) << 28,
          edges[0] | std::uint32_t{edges[1]} << 12, edges[2] | std::uint32_t{edges[3]} << 12, 0};
}

const std::array<SurfaceCase, 512>& surface_cases() {
  static const auto cases = [] {
    std::array<SurfaceCase, 512> all;
    for (int inside = 0; inside < 256; ++inside) {
      all[inside] = make_case(inside, -1);
      all[256 + inside] = make_case(inside, all[inside].doubtful_face);
    }
    return all;
  }();
  return cases;
}

}  // namespace isofield::engine
