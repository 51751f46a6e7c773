// How the surface runs through a cell, by which of its corners are inside: the tables of dual marching cubes (one
// vertex a patch, after Nielson 2004), worked out rather than written down.
//
// Numbering as in shaders/lib/mesh_constants.glsl: corner x + 2 y + 4 z; edge 4 axis + u + 2 v; faces -x, +x, -y, +y,
// -z, +z.
#pragma once

#include <array>
#include <cstdint>

namespace isofield::engine {

struct SurfaceCase {
  int patches = 0;
  std::array<std::uint8_t, 12> patch_of_edge{};  // of crossing edges
  std::array<std::uint16_t, 4> edges{};          // of each patch, a bit an edge
  // A face on which one patch has two segments: if the neighbour's does too, the mesh would use one edge twice. -1:
  // none.
  int doubtful_face = -1;

  std::array<std::uint32_t, 4> packed() const;  // as the shaders read it
};

// 0 to 255: by inside corners, ambiguous faces keeping the inside corners apart. 256 to 511: the same with the doubtful
// face joining them.
const std::array<SurfaceCase, 512>& surface_cases();

}  // namespace isofield::engine
