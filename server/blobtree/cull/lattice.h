// Lattices of points over a scene, cut into bricks that each have a pruned tape.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/for_each.h"
#include "blobtree/cull/pruner.h"
#include "blobtree/geometry/brick_set.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Points origin + (i, j, k) * spacing.
struct Lattice {
  dvec3 origin;
  dvec3 spacing;
  std::array<std::uint32_t, 3> cells{};  // along x, y, z

  // Cell (x, y, z) of those that are so many cells along each edge.
  Box box(std::uint32_t x, std::uint32_t y, std::uint32_t z, double cells_along) const {
    const dvec3 step{spacing.x * cells_along, spacing.y * cells_along, spacing.z * cells_along};
    return {{origin.x + step.x * x, origin.y + step.y * y, origin.z + step.z * z},
            {origin.x + step.x * (x + 1), origin.y + step.y * (y + 1), origin.z + step.z * (z + 1)}};
  }
};

// Cells along a brick's edge. Small bricks evaluate more shared corners but far fewer cells without surface, on shorter
// tapes: measured on the neuron at cell 16 (tests/bench).
inline constexpr std::uint32_t kBrickCells = 4;
inline constexpr std::uint32_t kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;

struct Brick {
  std::uint32_t x, y, z;  // in bricks
  std::uint32_t tape_begin, tape_count;
};

struct BrickList {
  std::vector<Brick> bricks;  // in Morton order
  std::vector<Instruction> code;
};

enum class Keep {
  kSurface,  // bricks that the surface f = iso may cross
  kSupport,  // bricks where the field may differ from 0
};

struct CullRequest {
  Lattice lattice;
  // Only these of its bricks.
  std::optional<BrickSet> within;
  Keep keep = Keep::kSurface;
  double iso = 0.5;
  // kSurface: what lies at the lattice's boundary counts as outside, so that the surface closes there.
  bool is_capped = false;
  double margin = 0;  // model units: tapes hold as far around their bricks, too
  double above = 0;   // model units: the same beyond their upper faces alone, and the surface there counts as theirs
  std::uint64_t max_bricks = ~0ull, max_instructions = ~0ull;
  // Asked now and then, by any of the threads; true gives up with CANCELLED.
  std::function<bool()> cancelled;
  base::ForEach for_each;
};

// RESOURCE_EXHAUSTED: more than max_bricks bricks, or tapes of more than max_instructions. Descends from the whole
// lattice to its bricks through cells of a hierarchy, each pruning its parent's tape, so that the cost follows the
// bricks kept and not the box.
absl::StatusOr<BrickList> cull(const Tape& tape, const CullRequest& request);

// Bricks on whose tapes that cull() makes the leaf may be: where its field may differ from 0. Positive leaves.
BrickSet bricks_of(const Leaf& leaf, const Lattice& lattice);

}  // namespace isofield::blobtree
