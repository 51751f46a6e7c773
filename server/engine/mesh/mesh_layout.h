// The constants and data layouts that the mesher's passes on the host share with their shaders.
// shaders/generators/layouts.cpp writes them as GLSL.
//
// Words of this room, in the order from large to small:
//   part    bricks of a mesh that are meshed in one go, and the bricks around them that their mesh depends on.
//   slab    consecutive bricks of a part, or quads, or points of a batch, whose work is one submission.
//   job     an entry of the list that a dispatch works through: a brick or an octet of it, or points of one tape.
//   octet   up to eight corners of a brick, which eight invocations sample.
// A piece (engine/simplify/) is what one thread simplifies of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isofield::engine {

// The push constants of every pass. The shaders see origin and cell as one vec4.
struct MeshConstants {
  float origin[3];          // the lower corner of the lattice
  float cell;               // edge length of a cell, model units
  std::uint32_t cells[4];   // cells of the lattice along x, y and z; the fourth number is unused
  std::uint32_t first = 0;  // the first brick, quad or job of this dispatch
  std::uint32_t count = 0;  // how many of them the dispatch takes
  float iso;                // the iso value of the field that is greater inside; -iso for signed fields
  std::uint32_t flags;      // the bits below
  float tolerance;          // the largest distance of vertices from the surface, in cells
  float shift;        // distance from a lattice point to the point that decides its side, model units (mesh_rounding.h)
  float near;         // a sample that differs from iso by no more may be on the surface
  float value_room;   // how far rounding of values takes such a sample from iso
  float slope_room;   // how far rounding of coordinates takes points, as a part of `shift` (mesh_settle.cpp)
  float just_inside;  // the number just above iso
};

// The bits of MeshConstants::flags.
inline constexpr std::uint32_t kIsCapped = 1;  // corners on the lattice's boundary count as outside
inline constexpr std::uint32_t kIsSigned = 2;  // the field is less inside
inline constexpr std::uint32_t kIsListed = 4;  // the dispatch is about listed bricks, not about those from `first` on

// The first vertex and the first quad of a brick; or its first fan, and 0.
using MeshStart = std::array<std::uint32_t, 2>;

// Bits that the mesher notes of a brick.
enum BrickKind : std::uint32_t {
  kKnowsCrossings = 1,  // its crossings and their normals are known; they place its vertices or those of bricks below
  kMayCrease = 2,       // its tape may make the surface turn sharply, within less than a cell
  kHasCreases = 4,      // at least one of its vertices lies on a crease
};

// The neighbours that a brick's vertices and quads depend on, by steps along x, y and z.
inline constexpr std::size_t kNeighbours = 12;
inline constexpr std::array<std::array<int, 3>, kNeighbours> kNeighbourSteps{{{-1, 0, 0},
                                                                              {1, 0, 0},
                                                                              {0, -1, 0},
                                                                              {0, 1, 0},
                                                                              {0, 0, -1},
                                                                              {0, 0, 1},
                                                                              {0, -1, -1},
                                                                              {-1, 0, -1},
                                                                              {-1, -1, 0},
                                                                              {0, 1, 1},
                                                                              {1, 0, 1},
                                                                              {1, 1, 0}}};
inline constexpr std::uint32_t kNoBrick = ~0u;
// The places, in kNeighbourSteps, of the neighbours above a brick; the brick's upper faces belong to them.
inline constexpr std::array<std::size_t, 6> kNeighboursAbove{1, 3, 5, 9, 10, 11};

// The octets of a brick: first those of its own corners, 4 along each axis, then those of the corners on its upper
// faces, which are other bricks' own.
inline constexpr std::uint32_t kOctetBits = 4, kOctets = 1u << kOctetBits, kOwnOctets = 8, kOctetCorners = 8;

// The ways in which a quad becomes triangles.
enum QuadCut : std::uint32_t {
  kCut02 = 0,   // along the diagonal from vertex 0 to vertex 2
  kCut13 = 1,   // along the other diagonal
  kCutFan = 2,  // four triangles around the crossing of its edge, which becomes a vertex
};

// The invocations of a workgroup, and the octets that it takes, in passes that do not give each brick a workgroup.
inline constexpr std::uint32_t kMeshInvocations = 64;
inline constexpr std::uint32_t kOctetsPerWorkgroup = kMeshInvocations / kOctetCorners;
// Returns the number of workgroups that hold this many invocations.
constexpr std::uint32_t mesh_groups(std::uint64_t invocations) {
  return static_cast<std::uint32_t>((invocations + kMeshInvocations - 1) / kMeshInvocations);
}

}  // namespace isofield::engine
