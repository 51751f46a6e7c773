// Finds, counts and filters the shells of a closed mesh. Shells are its connected parts: bodies, whose triangles face
// outward, and voids.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/mesh/mesh_cells.h"

namespace isofield::engine {

struct ShellCounts {
  std::uint64_t bodies = 0, voids = 0;  // shells with a positive volume, or 0; shells with a negative one
  // How many of them are slivers, and a vertex of the largest sliver.
  std::uint64_t sliver_bodies = 0, sliver_voids = 0;
  std::array<float, 3> sliver{};
};

// A shell is a sliver if its mean thickness, which is twice its volume over its area, is less than this many cells.
// Blends have layers in which the field hardly exceeds iso, and the corners of cells hit such a layer here and there.
inline constexpr double kSliverCells = 0.5;

// Counts the shells of a mesh. `parts` must be all parts of it, in order of place.
ShellCounts count_shells(const std::vector<std::shared_ptr<const MeshCells>>& parts, double cell_size);

// Says which shells of a mesh stay.
struct ShellFilter {
  bool largest_body = false;  // true: only the body with the largest volume stays, with its voids
  bool fill_voids = false;    // true: voids go, and so do the bodies that float inside them

  bool keeps_all() const { return !largest_body && !fill_voids; }
};

struct KeptShells {
  Mesh mesh;                    // its vertices and triangles keep their order
  ShellCounts shells, dropped;  // the shells that stay, and those that go
};
KeptShells keep_shells(const Mesh& mesh, const ShellFilter& filter, double cell_size);

}  // namespace isofield::engine
