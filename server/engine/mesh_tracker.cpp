#include "engine/mesh_tracker.h"

#include <absl/container/flat_hash_set.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "blobtree/leaf_placer.h"
#include "engine/mesh_lattice.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

using blobtree::Box;
using blobtree::BrickBox;
using blobtree::Float4;
using blobtree::Instruction;
using blobtree::Lattice;
using blobtree::Leaf;

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_record(const Leaf& leaf, const std::vector<Float4>& a, const std::vector<Float4>& b) {
  const std::size_t size = blobtree::leaf_record_size(leaf.operand) * sizeof(Float4);
  return std::memcmp(&a[leaf.record], &b[leaf.record], size) == 0;
}

bool same_lattice(const Lattice& a, const Lattice& b) {
  return !(a.origin != b.origin) && !(a.spacing != b.spacing);
}

bool meet(const BrickBox& a, const BrickBox& b) {
  for (int i = 0; i < 3; ++i) {
    if (a.low[i] >= b.high[i] || b.low[i] >= a.high[i]) return false;
  }
  return true;
}

BrickBox around(const BrickBox& a, std::uint32_t bricks) {
  BrickBox box = a;
  for (int i = 0; i < 3; ++i) {
    box.low[i] -= std::min(box.low[i], bricks);
    box.high[i] += bricks;
  }
  return box;
}

bool holds(const BrickBox& box, const std::array<std::uint32_t, 3>& brick) {
  for (int i = 0; i < 3; ++i) {
    if (brick[i] < box.low[i] || brick[i] >= box.high[i]) return false;
  }
  return true;
}

// Boxes that share bricks become one.
void join_boxes(std::vector<BrickBox>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (!meet(boxes[i], boxes[j])) continue;
      for (int a = 0; a < 3; ++a) {
        boxes[i].low[a] = std::min(boxes[i].low[a], boxes[j].low[a]);
        boxes[i].high[a] = std::max(boxes[i].high[a], boxes[j].high[a]);
      }
      boxes.erase(boxes.begin() + j);
      j = i;  // the larger one may meet those before
    }
  }
}

template <class T>
void append(std::string& bytes, const std::vector<T>& from, std::size_t begin, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(from.data() + begin), count * sizeof(T));
}

}  // namespace

std::optional<std::vector<Box>> changed_boxes(const ResidentScene& before, const ResidentScene& after) {
  const blobtree::Tape &a = before.tape(), &b = after.tape();
  const blobtree::ParameterBuffers &p = before.parameters(), &q = after.parameters();
  const bool same_program = a.law == operators::Law::kPositive && b.law == a.law && same_bytes(a.code, b.code) &&
                            same_bytes(p.operations, q.operations) && same_bytes(p.tables, q.tables) &&
                            a.volumes == b.volumes && a.leaves.size() == b.leaves.size();
  if (!same_program) return std::nullopt;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < a.leaves.size(); ++i) {
    if (same_record(a.leaves[i], p.leaves, q.leaves)) continue;
    // Signed fields reach everywhere.
    if (a.leaves[i].law != operators::Law::kPositive) return std::nullopt;
    boxes.push_back(a.leaves[i].support);
    boxes.push_back(b.leaves[i].support);
  }
  return boxes;
}

absl::StatusOr<MeshTracker::Update> MeshTracker::update(SceneLease scene, const MeshCallbacks& callbacks) {
  const SceneLease before = std::exchange(before_, nullptr);
  const auto run = [&]() -> absl::StatusOr<Update> {
    const auto boxes = before ? changed_boxes(*before, *scene) : std::nullopt;
    if (!boxes || before->tape().support.empty() || scene->tape().support.empty()) {
      return update_whole(*scene, callbacks);
    }
    ISOFIELD_ASSIGN_OR_RETURN(const Lattice old_lattice, mesh_lattice(before->tape(), request_));
    ISOFIELD_ASSIGN_OR_RETURN(const Lattice lattice, mesh_lattice(scene->tape(), request_));
    if (!same_lattice(old_lattice, lattice)) {
      bricks_.clear();
      ISOFIELD_ASSIGN_OR_RETURN(Update update, update_whole(*scene, callbacks));
      update.is_whole = true;
      return update;
    }
    Update all;
    ISOFIELD_ASSIGN_OR_RETURN(const std::vector<BrickBox> bricks, brick_boxes(*boxes, lattice));
    for (const BrickBox& box : bricks) {
      ISOFIELD_ASSIGN_OR_RETURN(Update update, update_part(*scene, box, callbacks));
      all.removed.insert(all.removed.end(), update.removed.begin(), update.removed.end());
      std::move(update.changed.begin(), update.changed.end(), std::back_inserter(all.changed));
    }
    return all;
  };
  if (!before) bricks_.clear();
  absl::StatusOr<Update> update = run();
  if (!update.ok()) return update;
  if (!before) update->is_whole = true;
  before_ = std::move(scene);
  return update;
}

std::uint64_t MeshTracker::vertices() const {
  std::uint64_t bytes = 0;
  for (const auto& [key, content] : bricks_) bytes += content.vertices.size();
  return bytes / (request_.with_normals ? 24 : 12);
}

std::uint64_t MeshTracker::triangles() const {
  std::uint64_t bytes = 0;
  for (const auto& [key, content] : bricks_) bytes += content.triangles.size();
  return bytes / 12;
}

absl::StatusOr<std::vector<BrickBox>> MeshTracker::brick_boxes(const std::vector<Box>& boxes,
                                                               const Lattice& lattice) const {
  // Bricks that have a corner in the closed box, with room for rounding.
  constexpr double kRoom = 1e-3;
  std::vector<BrickBox> found;
  for (const Box& box : boxes) {
    BrickBox bricks;
    bool is_within = true;
    const auto along = [&](int axis, double low, double high, double origin, double spacing) {
      const double size = spacing * blobtree::kBrickCells;
      const double first = std::floor((low - origin) / size - kRoom), last = std::floor((high - origin) / size + kRoom);
      const double most = std::ceil(static_cast<double>(lattice.cells[axis]) / blobtree::kBrickCells);
      is_within = is_within && last >= 0 && first < most;
      bricks.low[axis] = static_cast<std::uint32_t>(std::clamp(first, 0.0, most));
      bricks.high[axis] = static_cast<std::uint32_t>(std::clamp(last + 1, 0.0, most));
    };
    along(0, box.min.x, box.max.x, lattice.origin.x, lattice.spacing.x);
    along(1, box.min.y, box.max.y, lattice.origin.y, lattice.spacing.y);
    along(2, box.min.z, box.max.z, lattice.origin.z, lattice.spacing.z);
    if (is_within) found.push_back(bricks);
  }
  join_boxes(found);
  return found;
}

void MeshTracker::merge(const MeshCells& cells, std::vector<MeshCells>& changed) {
  MeshCells different;
  std::size_t vertex = 0, triangle = 0;
  for (const MeshBrick& b : cells.bricks) {
    Content content;
    append(content.vertices, cells.positions, 3 * vertex, 3 * std::size_t{b.vertices});
    if (!cells.normals.empty()) append(content.vertices, cells.normals, 3 * vertex, 3 * std::size_t{b.vertices});
    append(content.triangles, cells.corners, 3 * triangle, 3 * std::size_t{b.triangles});
    Content& known = bricks_[{b.x, b.y, b.z}];
    if (known != content) {
      const auto take = [](auto& to, const auto& from, std::size_t first, std::size_t count) {
        if (!from.empty()) to.insert(to.end(), from.begin() + 3 * first, from.begin() + 3 * (first + count));
      };
      different.bricks.push_back(b);
      take(different.positions, cells.positions, vertex, b.vertices);
      take(different.normals, cells.normals, vertex, b.vertices);
      take(different.corners, cells.corners, triangle, b.triangles);
      known = std::move(content);
    }
    vertex += b.vertices;
    triangle += b.triangles;
  }
  different.cells = cells.cells;
  if (!different.bricks.empty()) changed.push_back(std::move(different));
}

absl::StatusOr<MeshTracker::Update> MeshTracker::update_whole(const ResidentScene& scene,
                                                              const MeshCallbacks& callbacks) {
  Update update;
  absl::flat_hash_map<Key, Content> old = std::exchange(bricks_, {});
  ISOFIELD_RETURN_IF_ERROR(mesher_.cells(scene, request_, callbacks, [&](const MeshCells& cells) {
    for (const MeshBrick& b : cells.bricks) {
      const auto it = old.find(Key{b.x, b.y, b.z});
      if (it == old.end()) continue;
      bricks_[it->first] = std::move(it->second);
      old.erase(it);
    }
    merge(cells, update.changed);
    return absl::OkStatus();
  }));
  for (const auto& [key, content] : old) update.removed.push_back(key);
  std::sort(update.removed.begin(), update.removed.end());
  return update;
}

absl::StatusOr<MeshTracker::Update> MeshTracker::update_part(const ResidentScene& scene, const BrickBox& changed,
                                                             const MeshCallbacks& callbacks) {
  // Triangles of the bricks beside those that change stand on vertices of these. Their own vertices change only where a
  // face that both share is ambiguous; then one brick more is looked at.
  for (std::uint32_t reach = 1;; ++reach) {
    MeshRequest request = request_;
    request.part = around(changed, reach);
    const BrickBox inner = around(changed, reach - 1);
    MeshCells made;
    ISOFIELD_RETURN_IF_ERROR(mesher_.cells(scene, request, callbacks, [&](const MeshCells& cells) {
      made = cells;
      return absl::OkStatus();
    }));
    bool moves_vertices = false;
    absl::flat_hash_set<Key> present;
    std::size_t vertex = 0;
    for (const MeshBrick& b : made.bricks) {
      const Key key{b.x, b.y, b.z};
      present.insert(key);
      if (!holds(inner, key)) {
        std::string vertices;
        append(vertices, made.positions, 3 * vertex, 3 * std::size_t{b.vertices});
        const auto it = bricks_.find(key);
        moves_vertices =
            moves_vertices ||
            (it == bricks_.end() ? b.vertices > 0 : it->second.vertices.compare(0, vertices.size(), vertices) != 0);
      }
      vertex += b.vertices;
    }
    Update update;
    const BrickBox& box = *request.part;
    for (std::uint32_t z = box.low[2]; z < box.high[2]; ++z) {
      for (std::uint32_t y = box.low[1]; y < box.high[1]; ++y) {
        for (std::uint32_t x = box.low[0]; x < box.high[0]; ++x) {
          const Key key{x, y, z};
          const auto it = bricks_.find(key);
          if (it == bricks_.end() || present.contains(key)) continue;
          moves_vertices = moves_vertices || (!holds(inner, key) && !it->second.vertices.empty());
          update.removed.push_back(key);
        }
      }
    }
    if (moves_vertices) continue;
    for (const Key& key : update.removed) bricks_.erase(key);
    merge(made, update.changed);
    return update;
  }
}

}  // namespace isofield::engine
