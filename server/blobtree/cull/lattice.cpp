#include "blobtree/cull/lattice.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace isofield::blobtree {
namespace {

constexpr std::size_t kNotStored = ~std::size_t{0};

bool has_same_code(const Instruction& a, const Instruction& b) {
  return a.code == b.code && a.leaf == b.leaf && a.operation == b.operation && a.index == b.index;
}

// Cells that lie this many levels below the whole are culled by themselves, on any thread. A thread takes kSharesAtOnce
// of them at once.
constexpr std::uint32_t kSharedLevels = 3;
constexpr std::size_t kSharesAtOnce = 4;

// Culler does the work of one cull(), or that of some of its shares on another thread.
class Culler {
 public:
  Culler(const Tape& tape, const CullRequest& request) : tape_(tape), request_(request), pruner_(tape) {
    for (int a = 0; a < 3; ++a) {
      bricks_[a] = (request.lattice.cells[a] + kBrickCells - 1) / kBrickCells;
      wanted_.high[a] = request.within ? std::min(request.within->box().high[a], bricks_[a]) : bricks_[a];
      wanted_.low[a] = request.within ? request.within->box().low[a] : 0;
    }
  }

  absl::StatusOr<BrickList> run() {
    for (int a = 0; a < 3; ++a) {
      if (wanted_.low[a] >= wanted_.high[a]) return std::move(list_);
    }
    std::uint32_t level = 0;
    while ((std::uint64_t{1} << level) < *std::max_element(bricks_.begin(), bricks_.end())) ++level;
    const bool is_shared = request_.for_each && level > kSharedLevels;
    if (is_shared) shared_level_ = level - kSharedLevels;
    if (absl::Status s = descend({level, 0, 0, 0, 0}, tape_.code); !s.ok()) return s;
    if (is_shared) {
      if (absl::Status s = share(); !s.ok()) return s;
    }
    return std::move(list_);
  }

 private:
  // A Cell of the hierarchy has 2^level bricks along each edge.
  struct Cell {
    std::uint32_t level, x, y, z;
    std::size_t parent;  // index in levels_ of the tape that it starts from
  };
  // A Level is a tape on the way down, which the children of one cell share.
  struct Level {
    std::size_t begin, count;  // in arena_
    std::size_t stored;        // its place in the result, or kNotStored
  };

  // A Share is a cell that is culled by itself, with the place of its parent's tape in shared_code_.
  struct Share {
    Cell cell;
    std::size_t begin, count;
  };

  // Culls the cell `from` and all below it. `code` is the tape of the cell's parent.
  absl::Status descend(Cell from, std::span<const Instruction> code) {
    arena_.assign(code.begin(), code.end());
    levels_.assign(1, {0, arena_.size(), kNotStored});
    from.parent = 0;
    stack_.assign(1, from);
    while (!stack_.empty()) {
      if ((++ticks_ & 0x3ff) == 0 && request_.cancelled && request_.cancelled()) {
        return absl::CancelledError("the request was cancelled");
      }
      const Cell cell = stack_.back();
      stack_.pop_back();
      if (shared_level_ && cell.level == *shared_level_) {
        put_aside(cell);
        continue;
      }
      visit(cell);
      if (absl::Status s = check_size(); !s.ok()) return s;
    }
    return absl::OkStatus();
  }

  absl::Status check_size() const {
    if (list_.bricks.size() > request_.max_bricks) {
      return absl::ResourceExhaustedError(absl::StrCat("more than ", request_.max_bricks, " bricks"));
    }
    if (list_.code.size() > request_.max_instructions) {
      return absl::ResourceExhaustedError(absl::StrCat("more than ", request_.max_instructions, " instructions"));
    }
    return absl::OkStatus();
  }

  void put_aside(const Cell& cell) {
    Level& parent = levels_[cell.parent];
    if (parent.stored == kNotStored) {
      parent.stored = shared_code_.size();
      shared_code_.insert(shared_code_.end(), arena_.begin() + parent.begin,
                          arena_.begin() + parent.begin + parent.count);
    }
    shares_.push_back({cell, parent.stored, parent.count});
  }

  // Culls on all threads the cells that were put aside. The list is the one that a single thread makes, except that a
  // tape that several shares have in common stands in it once for each of them.
  absl::Status share() {
    const std::size_t parts = (shares_.size() + kSharesAtOnce - 1) / kSharesAtOnce;
    std::vector<absl::StatusOr<BrickList>> lists(parts, BrickList{});
    request_.for_each(parts, [&](std::size_t part) {
      Culler culler(tape_, request_);
      absl::Status status;
      for (std::size_t i = part * kSharesAtOnce; i < std::min((part + 1) * kSharesAtOnce, shares_.size()); ++i) {
        status.Update(culler.descend(shares_[i].cell, {&shared_code_[shares_[i].begin], shares_[i].count}));
        if (!status.ok()) break;
      }
      lists[part] = status.ok() ? absl::StatusOr<BrickList>(std::move(culler.list_)) : status;
    });
    for (const absl::StatusOr<BrickList>& list : lists) {
      if (!list.ok()) return list.status();
      const auto begin = static_cast<std::uint32_t>(list_.code.size());
      list_.code.insert(list_.code.end(), list->code.begin(), list->code.end());
      for (Brick b : list->bricks) {
        b.tape_begin += begin;
        list_.bricks.push_back(b);
      }
      if (absl::Status s = check_size(); !s.ok()) return s;
    }
    return absl::OkStatus();
  }

  // Returns the box of the wanted bricks in the cell, so that a few bricks have a short tape from the first cell on.
  Box box_of(const Cell& cell) const {
    const auto first = [&](std::uint32_t i, int axis) { return std::max(i << cell.level, wanted_.low[axis]); };
    const auto last = [&](std::uint32_t i, int axis) {
      const std::uint64_t end = (std::uint64_t{i} + 1) << cell.level;
      return request_.within ? static_cast<std::uint32_t>(std::min<std::uint64_t>(end, wanted_.high[axis])) - 1
                             : static_cast<std::uint32_t>(end - 1);
    };
    const Lattice& lattice = request_.lattice;
    const Box low = lattice.box(first(cell.x, 0), first(cell.y, 1), first(cell.z, 2), kBrickCells);
    const Box high = lattice.box(last(cell.x, 0), last(cell.y, 1), last(cell.z, 2), kBrickCells);
    const auto along = [](double length) { return dvec3{length, length, length}; };
    return {low.min - along(request_.margin), high.max + along(request_.margin + request_.above)};
  }

  bool is_kept(const Cell& cell, const Pruned& p) const {
    if (request_.keep == Keep::kSupport) return !p.is_zero;
    const bool may_be_inside =
        tape_.law == operators::Law::kSigned ? p.range.lo <= request_.iso : p.range.hi >= request_.iso;
    const bool may_be_outside =
        tape_.law == operators::Law::kSigned ? p.range.hi >= request_.iso : p.range.lo <= request_.iso;
    return may_be_inside && (may_be_outside || (request_.is_capped && is_at_boundary(cell)));
  }

  bool is_at_boundary(const Cell& cell) const {
    const auto at_end = [&](std::uint32_t i, int axis) {
      return i == 0 || (std::uint64_t{i} + 1) << cell.level >= bricks_[axis];
    };
    return at_end(cell.x, 0) || at_end(cell.y, 1) || at_end(cell.z, 2);
  }

  void visit(const Cell& cell) {
    // Cells are visited depth first, so that whatever lies above the parent's tape in the arena is no longer needed.
    levels_.resize(cell.parent + 1);
    const Level parent = levels_[cell.parent];
    const std::size_t begin = parent.begin + parent.count;
    arena_.resize(begin);
    const Pruned pruned = pruner_.prune(arena_, parent.begin, parent.count, box_of(cell), arena_);
    if (!is_kept(cell, pruned)) return;
    const std::size_t count = arena_.size() - begin;
    // If nothing dropped out, the children use the parent's tape, which may be in the result already.
    const bool same = count == parent.count &&
                      std::equal(arena_.begin() + begin, arena_.end(), arena_.begin() + parent.begin, has_same_code);
    if (cell.level == 0) {
      if (same) {
        if (parent.stored == kNotStored) levels_[cell.parent].stored = store(parent.begin, parent.count);
        add_brick(cell, levels_[cell.parent].stored, count);
      } else {
        add_brick(cell, store(begin, count), count);
      }
      return;
    }
    std::size_t level = cell.parent;
    if (!same) {
      levels_.push_back({begin, count, kNotStored});
      level = levels_.size() - 1;
    } else {
      arena_.resize(begin);
    }
    const std::uint32_t half = std::uint32_t{1} << (cell.level - 1);
    for (int child = 7; child >= 0; --child) {
      const Cell c{cell.level - 1, 2 * cell.x + (child & 1), 2 * cell.y + (child >> 1 & 1), 2 * cell.z + (child >> 2),
                   level};
      if (is_wanted(c, half)) stack_.push_back(c);
    }
  }

  // Returns whether some of the wanted bricks may be in a cell of `bricks` bricks along each edge.
  bool is_wanted(const Cell& c, std::uint32_t bricks) const {
    if (c.level == 0 && request_.within && !request_.within->contains(c.x, c.y, c.z)) return false;
    return meets(c.x, bricks, 0) && meets(c.y, bricks, 1) && meets(c.z, bricks, 2);
  }
  bool meets(std::uint32_t i, std::uint32_t bricks, int axis) const {
    return std::uint64_t{i} * bricks < wanted_.high[axis] && (std::uint64_t{i} + 1) * bricks > wanted_.low[axis];
  }

  std::size_t store(std::size_t begin, std::size_t count) {
    const std::size_t at = list_.code.size();
    list_.code.insert(list_.code.end(), arena_.begin() + begin, arena_.begin() + begin + count);
    return at;
  }
  void add_brick(const Cell& cell, std::size_t at, std::size_t count) {
    list_.bricks.push_back({cell.x, cell.y, cell.z, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(count)});
  }

  const Tape& tape_;
  const CullRequest& request_;
  Pruner pruner_;
  std::array<std::uint32_t, 3> bricks_{};
  BrickBox wanted_;
  std::vector<Instruction> arena_;
  std::vector<Level> levels_;
  std::vector<Cell> stack_;
  std::uint32_t ticks_ = 0;
  std::optional<std::uint32_t> shared_level_;  // level of the cells that are put aside
  std::vector<Share> shares_;
  std::vector<Instruction> shared_code_;
  BrickList list_;
};

}  // namespace

absl::StatusOr<BrickList> cull(const Tape& tape, const CullRequest& request) {
  return Culler(tape, request).run();
}

BrickSet bricks_of(const Leaf& leaf, const Lattice& lattice) {
  constexpr double kRoom = 1e-3;  // part of a brick, for rounding
  BrickBox around;
  const auto along = [&](int axis, double low, double high, double origin, double spacing) {
    const double size = spacing * kBrickCells;
    const double most = std::ceil(static_cast<double>(lattice.cells[axis]) / kBrickCells);
    const double first = std::floor((low - origin) / size - kRoom), last = std::floor((high - origin) / size + kRoom);
    around.low[axis] = static_cast<std::uint32_t>(std::clamp(first, 0.0, most));
    around.high[axis] = static_cast<std::uint32_t>(std::clamp(last + 1, 0.0, most));
  };
  const Box& support = leaf.support;
  along(0, support.min.x, support.max.x, lattice.origin.x, lattice.spacing.x);
  along(1, support.min.y, support.max.y, lattice.origin.y, lattice.spacing.y);
  along(2, support.min.z, support.max.z, lattice.origin.z, lattice.spacing.z);
  return BrickSet(around, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return !vanishes(leaf, lattice.box(x, y, z, kBrickCells));
  });
}

}  // namespace isofield::blobtree
