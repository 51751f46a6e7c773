// The binding numbers at which kernels find their buffers, in one table for the host and the shaders. C++ names them
// like binding::mesh::kCells, and shaders/generators/layouts.cpp writes them for the shaders like BINDING_MESH_CELLS.
#pragma once

#include <cstdint>

// BINDING(family, name, number). A family is an entry point of shaders/, or a header of shaders/lib/ that several of
// them share. An entry point may use the names of its headers' families, and its own may not repeat their numbers.
#define ISOFIELD_BINDINGS(BINDING)                                                                                   \
  /* A resident scene (lib/parameters.glsl, lib/volume.glsl). Uniform buffers begin at gpu::kFirstUniformBinding. */ \
  BINDING(scene, Leaves, 0)                                                                                          \
  BINDING(scene, Operations, 1)                                                                                      \
  BINDING(scene, Tables, 2)                                                                                          \
  BINDING(scene, Tape, 3)                                                                                            \
  BINDING(scene, FirstVolume, 12)                                                                                    \
  BINDING(scene, UniformLeaves, 16)                                                                                  \
  BINDING(scene, UniformOperations, 17)                                                                              \
  BINDING(scene, UniformTape, 18)                                                                                    \
  /* lib/bricks.glsl */                                                                                              \
  BINDING(lattice, Bricks, 4)                                                                                        \
  /* points.comp, tape_points.comp and sorted_points.comp; grid.comp uses Results, too (lib/output.glsl). */         \
  BINDING(points, Points, 6)                                                                                         \
  BINDING(points, Results, 7)                                                                                        \
  BINDING(sorted_points, Jobs, 4)                                                                                    \
  BINDING(sorted_points, Points, 5)                                                                                  \
  /* operator_eval.comp, operator_volume.comp, sampled_volume.comp, operator_volume_probe.comp */                    \
  BINDING(operator_eval, Arguments, 4)                                                                               \
  BINDING(operator_eval, Results, 5)                                                                                 \
  BINDING(operator_volume, Angles, 4)                                                                                \
  BINDING(operator_volume, Nodes, 5)                                                                                 \
  BINDING(sampled_volume, Samples, 4)                                                                                \
  BINDING(sampled_volume, Nodes, 5)                                                                                  \
  BINDING(volume_probe, Arguments, 4)                                                                                \
  BINDING(volume_probe, Results, 5)                                                                                  \
  /* The buffers that most passes of the mesher share; then those of each pass, in the order in which they run. */   \
  BINDING(mesh, Jobs, 5)                                                                                             \
  BINDING(mesh, SurfaceCases, 5)                                                                                     \
  BINDING(mesh, Cells, 6)                                                                                            \
  BINDING(mesh, Neighbours, 7)                                                                                       \
  BINDING(mesh, Starts, 8)                                                                                           \
  BINDING(mesh, Vertices, 9)                                                                                         \
  BINDING(mesh, Quads, 9)                                                                                            \
  BINDING(mesh, Crossings, 10)                                                                                       \
  BINDING(mesh, Positions, 11)                                                                                       \
  BINDING(mesh_sample, Samples, 6)                                                                                   \
  BINDING(mesh_share, Octets, 5)                                                                                     \
  BINDING(mesh_share, Samples, 6)                                                                                    \
  BINDING(mesh_classify, Samples, 5)                                                                                 \
  BINDING(mesh_classify, Cases, 6)                                                                                   \
  BINDING(mesh_classify, NearBricks, 7)                                                                              \
  BINDING(mesh_classify, Listed, 8)                                                                                  \
  BINDING(mesh_near, Listed, 5)                                                                                      \
  BINDING(mesh_near, Samples, 6)                                                                                     \
  BINDING(mesh_near, NearOctets, 7)                                                                                  \
  BINDING(mesh_settle, Octets, 5)                                                                                    \
  BINDING(mesh_settle, Samples, 6)                                                                                   \
  BINDING(mesh_settle, Beside, 7)                                                                                    \
  BINDING(mesh_settle, Listed, 8)                                                                                    \
  BINDING(mesh_connect, Cases, 6)                                                                                    \
  BINDING(mesh_connect, Cells, 8)                                                                                    \
  BINDING(mesh_connect, Counts, 9)                                                                                   \
  BINDING(mesh_list, Starts, 7)                                                                                      \
  BINDING(mesh_list, Vertices, 8)                                                                                    \
  BINDING(mesh_crossings, Samples, 6)                                                                                \
  BINDING(mesh_place, Kinds, 12)                                                                                     \
  BINDING(mesh_place, Samples, 13)                                                                                   \
  BINDING(mesh_place, Placed, 14)                                                                                    \
  BINDING(mesh_vertices, SurfaceCases, 7)                                                                            \
  BINDING(mesh_normals, Starts, 6)                                                                                   \
  BINDING(mesh_normals, Positions, 7)                                                                                \
  BINDING(mesh_normals, Normals, 8)                                                                                  \
  BINDING(mesh_quads, Cuts, 12)                                                                                      \
  BINDING(mesh_quads, Kinds, 13)                                                                                     \
  BINDING(mesh_quads, Corners, 14)                                                                                   \
  BINDING(mesh_triangles, Corners, 11)                                                                               \
  BINDING(mesh_triangles, Cuts, 12)                                                                                  \
  BINDING(mesh_triangles, Triangles, 13)                                                                             \
  BINDING(mesh_triangles, Centres, 14)                                                                               \
  BINDING(mesh_triangles, FanStarts, 15)

namespace isofield::engine {

// Bits of KernelKind::uniform_set: they say which parameters a kernel reads from uniform buffers, and how
// (shaders/lib/parameters.glsl).
inline constexpr std::uint32_t kLeavesAreUniform = 1, kOperationsAreUniform = 2, kTapeIsUniform = 4;
inline constexpr std::uint32_t kLoadsAreShared = 8;  // the invocations of a subgroup load together

}  // namespace isofield::engine

#define ISOFIELD_BINDING(family, name, number)     \
  namespace isofield::engine::binding::family {    \
  inline constexpr std::uint32_t k##name = number; \
  }
ISOFIELD_BINDINGS(ISOFIELD_BINDING)
#undef ISOFIELD_BINDING
