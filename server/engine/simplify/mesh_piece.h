// A piece of a mesh that is being simplified.
#pragma once

#include <absl/container/flat_hash_set.h>

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/triangle.h"

namespace isofield::engine {

// The lower vertex in the upper half.
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a < b ? a : b} << 32 | (a < b ? b : a);
}

// The edges of a mesh as it is, and those that come to it. Those that go are not forgotten.
class MeshEdges {
 public:
  MeshEdges(std::span<const Triangle> triangles, std::size_t vertices);
  bool contains(std::uint64_t edge) const;
  void insert(std::uint64_t edge) { added_.insert(edge); }

 private:
  std::vector<std::uint32_t> starts_, ends_;  // by the lower vertex, the higher ones
  absl::flat_hash_set<std::uint64_t> added_;
};

// Turns the longest edges of triangles without height, with vertices in line, where that makes better ones. Edges that
// one triangle alone has stay.
void turn_flat(std::span<const float> positions, std::vector<Triangle>& triangles);

// How triangles `after` fail to take the place of `before` in a mesh that is a closed 2-manifold so that it stays one:
// they have the same border, its vertices are joined by no edge that the rest of the mesh has, and triangles form one
// fan around each vertex.
struct Fit {
  std::vector<std::uint32_t> misfits;  // vertices about which that fails
  bool has_same_handles = false;       // and parts
  std::vector<std::uint64_t> chords;   // edges that `after` has between vertices of the border, and `before` has not
};
Fit fit(std::span<const Triangle> before, std::span<const Triangle> after, const MeshEdges& mesh);

}  // namespace isofield::engine
