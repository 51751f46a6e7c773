// Tells how the surface runs through a cell, by which of the cell's corners are inside. These are the tables of dual
// marching cubes (one vertex a patch, after Nielson 2004), which the code computes.
//
// The numbering is that of shaders/lib/mesh_constants.glsl: corner x + 2 y + 4 z; edge 4 axis + u + 2 v, with (u, v)
// the offsets along the next two axes in cyclic order; faces -x, +x, -y, +y, -z, +z.
#pragma once

#include <array>
#include <cstdint>

namespace isofield::engine {

// The patches of the surface in a cell; each becomes a vertex.
struct SurfaceCase {
  int patches = 0;
  std::array<std::uint8_t, 12> patch_of_edge{};  // for each edge that the surface crosses
  std::array<std::uint16_t, 4> edges{};          // the edges of each patch, a bit each
  // A face on which one patch has two segments, or -1. If the neighbour's patch has two segments there as well, the
  // mesh would use one edge twice.
  int doubtful_face = -1;

  std::array<std::uint32_t, 4> packed() const;  // in the form that the shaders read
};

// Cases 0 to 255 are numbered by the inside corners, a bit each; inside corners of an ambiguous face are kept apart
// there. Cases 256 to 511 are the same, except that the doubtful face joins them.
const std::array<SurfaceCase, 512>& surface_cases();

}  // namespace isofield::engine
