// Makes the triangulated surface of a cube, from which tests build meshes of any type.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace isofield::test_support {

struct CubeGrid {
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<double, 3>> sides;  // outward normals; a vertex on an edge has the normal of one of its sides
  std::vector<std::uint32_t> triangles;      // counter-clockwise from outside
};

// Makes the cube [-1, 1]^3 with n squares along each edge. Its sides share the vertices on their edges.
inline CubeGrid cube_grid(int n) {
  CubeGrid grid;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const auto vertex = [&](int i, int j) {
        std::array<int, 3> at{};
        at[axis] = sign > 0 ? n : 0;
        at[(axis + 1) % 3] = i;
        at[(axis + 2) % 3] = j;
        const auto [place, is_new] = numbers.try_emplace(at, static_cast<std::uint32_t>(grid.places.size()));
        if (is_new) {
          grid.places.push_back({2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1});
          grid.sides.emplace_back();
        }
        grid.sides[place->second] = {};
        grid.sides[place->second][axis] = sign;
        return place->second;
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          std::array<std::uint32_t, 4> q{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
          if (sign < 0) std::swap(q[1], q[3]);
          grid.triangles.insert(grid.triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
        }
      }
    }
  }
  return grid;
}

}  // namespace isofield::test_support
