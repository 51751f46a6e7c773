// Tools for a piece of a mesh that is being simplified: they tell whether new triangles fit into its place, and improve
// flat ones.
#pragma once

#include <absl/container/flat_hash_set.h>

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/triangle.h"

namespace isofield::engine {

// Returns the key of an edge, the same in both directions: the lower vertex number is in the upper half.
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a < b ? a : b} << 32 | (a < b ? b : a);
}

// The set of the edges of a mesh, and of edges that are added while it is simplified. Edges that vanish from the mesh
// stay in the set. Not thread-safe.
class MeshEdges {
 public:
  MeshEdges(std::span<const Triangle> triangles, std::size_t vertices);
  bool contains(std::uint64_t edge) const;
  void insert(std::uint64_t edge) { added_.insert(edge); }

 private:
  // The higher vertices of the edges of each lower vertex v: ends_[starts_[v]] up to ends_[starts_[v + 1]].
  std::vector<std::uint32_t> starts_, ends_;
  absl::flat_hash_set<std::uint64_t> added_;
};

// Improves triangles whose vertices nearly lie in a line: it replaces their longest edge by the other diagonal of the
// two triangles at it, if that makes better ones. Edges that only one triangle has stay.
void turn_flat(std::span<const float> positions, std::vector<Triangle>& triangles);

// Says whether triangles `after` can take the place of triangles `before` in a mesh that is a closed 2-manifold, so
// that it stays one. For that they must have the same border, join its vertices by no edge that the rest of the mesh
// has, and form as many fans around each vertex as before.
struct Fit {
  std::vector<std::uint32_t> misfits;  // the vertices at which one of these rules is broken
  bool has_same_handles = false;       // true: the Euler characteristic, and so handles and parts, are the same
  std::vector<std::uint64_t> chords;   // edges between vertices of the border that `after` has and `before` has not
};
Fit fit(std::span<const Triangle> before, std::span<const Triangle> after, const MeshEdges& mesh);

}  // namespace isofield::engine
