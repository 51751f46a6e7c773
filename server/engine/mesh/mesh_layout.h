// What the mesher's passes on the host and their shaders agree upon: shaders/generators/layouts.cpp writes it as GLSL.
//
// Words of this room, in the order from large to small:
//   part    bricks of a mesh that are meshed by themselves, with those around them that their mesh depends on.
//   slab    consecutive bricks of a part, or quads, or points of a batch, whose work is one submission.
//   job     an entry of the list that a dispatch works through: a brick and what of it, or points of one tape.
//   octet   up to eight corners of a brick, which eight invocations sample.
// A piece (engine/simplify/) is what one thread simplifies of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isofield::engine {

// What every pass is told: push constants. The shaders see origin and cell as one vec4.
struct MeshConstants {
  float origin[3];  // of the lattice
  float cell;
  std::uint32_t cells[4];   // of the lattice along x, y, z
  std::uint32_t first = 0;  // of the bricks, or jobs, of this dispatch
  std::uint32_t count = 0;
  float iso;            // of a field that is greater inside: of a signed one, its negative's
  std::uint32_t flags;  // below
  float tolerance;      // of vertices' distances from the surface, in cells
  float shift;          // how far beside a lattice point the field decides for it, model units (mesh_rounding.h)
  float near;           // samples this near to iso may be on the surface
  float value_room;     // of those: how far rounding alone takes values from iso,
  float slope_room;     // and how far it takes points, as a part of `shift`
  float just_inside;    // the number above iso
};

// MeshConstants::flags.
inline constexpr std::uint32_t kIsCapped = 1;  // corners on the lattice's boundary count as outside
inline constexpr std::uint32_t kIsSigned = 2;  // the field is less inside
inline constexpr std::uint32_t kIsListed = 4;  // the dispatch is about listed bricks, not about those from `first` on

// First vertex and first quad of a brick, or its first fan and 0.
using MeshStart = std::array<std::uint32_t, 2>;

// Of a brick, as bits.
enum BrickKind : std::uint32_t {
  kKnowsCrossings = 1,  // with the normals there: vertices of this brick or of one below it are placed by them
  kMayCrease = 2,       // something on its tape may make the surface turn within less than a cell
  kHasCreases = 4,      // a vertex was found that lies on one
};

// The bricks beside one that its cells' vertices and quads depend on, by steps along x, y and z.
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
// Those above it, of which the upper faces of a brick are.
inline constexpr std::array<std::size_t, 6> kNeighboursAbove{1, 3, 5, 9, 10, 11};

// The octets of a brick: those of the corners at which it begins, then those on its upper faces, which are others' own.
inline constexpr std::uint32_t kOctetBits = 4, kOctets = 1u << kOctetBits, kOwnOctets = 8, kOctetCorners = 8;

// How a quad becomes triangles.
enum QuadCut : std::uint32_t {
  kCut02 = 0,  // along the diagonal of the vertices 0 and 2
  kCut13 = 1,
  kCutFan = 2,  // four triangles around the crossing of its edge, which becomes a vertex
};

// Invocations of a workgroup of the passes that do not give each brick one; the octets that it takes; and how many
// workgroups take so many invocations.
inline constexpr std::uint32_t kMeshInvocations = 64;
inline constexpr std::uint32_t kOctetsPerWorkgroup = kMeshInvocations / kOctetCorners;
constexpr std::uint32_t mesh_groups(std::uint64_t invocations) {
  return static_cast<std::uint32_t>((invocations + kMeshInvocations - 1) / kMeshInvocations);
}

}  // namespace isofield::engine
