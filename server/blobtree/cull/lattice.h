// cull() cuts a lattice of points over a scene into bricks, keeps those that matter, and prunes a tape for each.
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

// A Lattice is the points origin + (i, j, k) * spacing.
struct Lattice {
  dvec3 origin;
  dvec3 spacing;
  std::array<std::uint32_t, 3> cells{};  // their numbers along x, y, z

  // Returns the box at (x, y, z) of those that are `cells_along` cells along each edge.
  Box box(std::uint32_t x, std::uint32_t y, std::uint32_t z, double cells_along) const {
    const dvec3 step{spacing.x * cells_along, spacing.y * cells_along, spacing.z * cells_along};
    return {{origin.x + step.x * x, origin.y + step.y * y, origin.z + step.z * z},
            {origin.x + step.x * (x + 1), origin.y + step.y * (y + 1), origin.z + step.z * (z + 1)}};
  }
};

// A brick has this many cells along its edge. Small bricks evaluate more shared corners but far fewer cells without
// surface, and on shorter tapes (measured in tests/bench).
inline constexpr std::uint32_t kBrickCells = 4;
inline constexpr std::uint32_t kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;

// A Brick has its place in the lattice, and its tape as a range of BrickList::code.
struct Brick {
  std::uint32_t x, y, z;  // in bricks
  std::uint32_t tape_begin, tape_count;
};

struct BrickList {
  std::vector<Brick> bricks;  // in Morton order
  std::vector<Instruction> code;
};

// Keep says which bricks cull() returns.
enum class Keep {
  kSurface,  // bricks that the surface f = iso may cross
  kSupport,  // bricks where the field may differ from 0
};

// CullRequest says what cull() does.
struct CullRequest {
  Lattice lattice;
  // If there is a set, only its bricks are kept.
  std::optional<BrickSet> within;
  Keep keep = Keep::kSurface;
  double iso = 0.5;
  // For kSurface: everything at the lattice's boundary counts as outside, so that the surface closes there.
  bool is_capped = false;
  // A brick's box is grown by `margin` on all sides, and by `above` more beyond its upper faces. Its tape holds there,
  // and the surface there counts as its own. Both are in model units.
  double margin = 0;
  double above = 0;
  std::uint64_t max_bricks = ~0ull, max_instructions = ~0ull;
  // cull() calls this now and then on any of its threads, and gives up with CANCELLED if it returns true.
  std::function<bool()> cancelled;
  // Without this, one thread culls all.
  base::ForEach for_each;
};

// Returns the bricks that the request keeps, with their tapes. RESOURCE_EXHAUSTED: there are more than max_bricks
// bricks, or their tapes have more than max_instructions instructions. The function descends from the whole lattice to
// its bricks through a hierarchy of cells, each of which prunes its parent's tape, so that the cost grows with the
// bricks that are kept and not with the box.
absl::StatusOr<BrickList> cull(const Tape& tape, const CullRequest& request);

// Returns the bricks whose tapes, as cull() makes them, may contain the leaf, because its field may differ from 0
// there. The leaf's field must be positive.
BrickSet bricks_of(const Leaf& leaf, const Lattice& lattice);

}  // namespace isofield::blobtree
