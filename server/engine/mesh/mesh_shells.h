// The shells of a closed mesh, which are its connected parts: bodies, whose triangles face outward, and voids.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/mesh/mesh_cells.h"

namespace isofield::engine {

struct ShellCounts {
  std::uint64_t bodies = 0, voids = 0;  // shells that enclose more than nothing, and less
  // How many of them are slivers, and a vertex of the largest sliver.
  std::uint64_t sliver_bodies = 0, sliver_voids = 0;
  std::array<float, 3> sliver{};
};

// A shell is a sliver where its mean thickness, twice its volume over its area, is less than so many cells. Blends have
// layers in which the field hardly exceeds iso; the corners of cells hit such a layer here and there.
inline constexpr double kSliverCells = 0.5;

// `parts` are all of a mesh, in order of place.
ShellCounts count_shells(const std::vector<std::shared_ptr<const MeshCells>>& parts, double cell_size);

// Says which shells of a mesh stay.
struct ShellFilter {
  bool largest_body = false;  // the body that encloses most, alone, with its voids
  bool fill_voids = false;    // neither voids nor the bodies that float inside of them

  bool keeps_all() const { return !largest_body && !fill_voids; }
};

struct KeptShells {
  Mesh mesh;  // vertices and triangles in the order that they had
  ShellCounts shells, dropped;
};
KeptShells keep_shells(const Mesh& mesh, const ShellFilter& filter, double cell_size);

}  // namespace isofield::engine
