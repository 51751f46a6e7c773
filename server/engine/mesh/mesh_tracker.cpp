#include "engine/mesh/mesh_tracker.h"

#include <absl/container/flat_hash_set.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/status_macros.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_rounding.h"

namespace isofield::engine {
namespace {

using blobtree::BrickBox;
using blobtree::BrickSet;
using blobtree::Float4;
using blobtree::Instruction;
using blobtree::Lattice;
using blobtree::Leaf;

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_record(const Leaf& leaf, const std::vector<Float4>& a, const std::vector<Float4>& b) {
  const std::size_t size = blobtree::record_size(leaf.operand) * sizeof(Float4);
  return std::memcmp(&a[leaf.record], &b[leaf.record], size) == 0;
}

bool same_lattice(const Lattice& a, const Lattice& b) {
  return !(a.origin != b.origin) && !(a.spacing != b.spacing);
}

// Joins sets that are near each other, because their parts of the mesh would overlap.
void join_near(std::vector<BrickSet>& sets) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (std::size_t j = i + 1; j < sets.size(); ++j) {
      if (!blobtree::meet(sets[i].box().grown(2, 2), sets[j].box())) continue;
      sets[i] = sets[i].joined(sets[j]);
      sets.erase(sets.begin() + j);
      j = i;  // the larger set may be near sets that were not near before
    }
  }
}

template <class T>
void append(std::string& bytes, const std::vector<T>& from, std::size_t begin, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(from.data() + begin), count * sizeof(T));
}

}  // namespace

std::optional<std::vector<const Leaf*>> changed_leaves(const ResidentScene& before, const ResidentScene& after) {
  const blobtree::Tape &a = before.tape(), &b = after.tape();
  const blobtree::ParameterBuffers &p = before.parameters(), &q = after.parameters();
  const bool same_program = a.law == operators::Law::kPositive && b.law == a.law && same_bytes(a.code, b.code) &&
                            same_bytes(p.operations, q.operations) && same_bytes(p.tables, q.tables) &&
                            a.volumes == b.volumes && a.leaves.size() == b.leaves.size();
  if (!same_program) return std::nullopt;
  std::vector<const Leaf*> leaves;
  for (std::size_t i = 0; i < a.leaves.size(); ++i) {
    if (same_record(a.leaves[i], p.leaves, q.leaves)) continue;
    // A signed field has no support, so a change reaches everywhere.
    if (a.leaves[i].law != operators::Law::kPositive) return std::nullopt;
    leaves.push_back(&a.leaves[i]);
    leaves.push_back(&b.leaves[i]);
  }
  return leaves;
}

absl::StatusOr<MeshTracker::Update> MeshTracker::update(SceneLease scene, const MeshCallbacks& callbacks) {
  const SceneLease before = std::exchange(before_, nullptr);
  const auto run = [&]() -> absl::StatusOr<Update> {
    const auto leaves = before ? changed_leaves(*before, *scene) : std::nullopt;
    if (!leaves || before->tape().support.empty() || scene->tape().support.empty()) {
      return update_whole(*scene, callbacks);
    }
    ISOFIELD_ASSIGN_OR_RETURN(const Lattice old_lattice, mesh_lattice(before->tape(), request_));
    ISOFIELD_ASSIGN_OR_RETURN(const Lattice lattice, mesh_lattice(scene->tape(), request_));
    if (!same_lattice(old_lattice, lattice) || !(mesh_rounding(before->tape(), old_lattice, request_.iso) ==
                                                 mesh_rounding(scene->tape(), lattice, request_.iso))) {
      bricks_.clear();
      ISOFIELD_ASSIGN_OR_RETURN(Update update, update_whole(*scene, callbacks));
      update.is_whole = true;
      return update;
    }
    Update all;
    std::vector<BrickSet> changed;
    for (const Leaf* leaf : *leaves) changed.push_back(blobtree::bricks_of(*leaf, lattice));
    join_near(changed);
    for (std::size_t part = 0; part < changed.size(); ++part) {
      ISOFIELD_ASSIGN_OR_RETURN(Update update, update_part(*scene, changed, part, callbacks));
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

absl::StatusOr<MeshTracker::Update> MeshTracker::update_part(const ResidentScene& scene,
                                                             const std::vector<BrickSet>& changed, std::size_t part,
                                                             const MeshCallbacks& callbacks) {
  const auto may_hold_surface = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return bricks_.contains({x, y, z}) ||
           std::any_of(changed.begin(), changed.end(), [&](const BrickSet& set) { return set.contains(x, y, z); });
  };
  // Vertices in neighbours of changed bricks change only if a face between them is ambiguous. If any do, the part is
  // made again with the neighbours in it.
  for (std::uint32_t reach = 0;; ++reach) {
    const BrickSet moved = changed[part].grown(reach, reach);
    PartSets sets(moved.grown(0, 1));  // triangles belong to the uppermost brick that they have a vertex in
    sets.placed = moved.grown(1, 1);
    sets.crossed = moved.grown(1, 2);
    const BrickSet sampled = moved.grown(2, 2);
    sets.sampled = BrickSet(sampled.box(), [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return sampled.contains(x, y, z) && may_hold_surface(x, y, z);
    });
    ISOFIELD_ASSIGN_OR_RETURN(const PartMesh made, mesher_.part(scene, request_, sets, callbacks));
    absl::flat_hash_set<Key> present;
    bool moves_others = false;
    const auto look_at = [&](const MeshCells& cells) {
      std::size_t vertex = 0;
      for (const MeshBrick& b : cells.bricks) {
        const Key key{b.x, b.y, b.z};
        present.insert(key);
        if (!moved.contains(b.x, b.y, b.z)) {
          std::string vertices;
          append(vertices, cells.positions, 3 * vertex, 3 * std::size_t{b.vertices});
          const auto it = bricks_.find(key);
          moves_others |= it == bricks_.end() || it->second.vertices.compare(0, vertices.size(), vertices) != 0;
        }
        vertex += b.vertices;
      }
    };
    look_at(made.cells);
    look_at(made.beside);
    Update update;
    const BrickBox& box = sets.placed.box();
    for (std::uint32_t z = box.low[2]; z < box.high[2]; ++z) {
      for (std::uint32_t y = box.low[1]; y < box.high[1]; ++y) {
        for (std::uint32_t x = box.low[0]; x < box.high[0]; ++x) {
          const Key key{x, y, z};
          if (!sets.placed.contains(x, y, z) || present.contains(key) || !bricks_.contains(key)) continue;
          moves_others |= !moved.contains(x, y, z);
          update.removed.push_back(key);
        }
      }
    }
    if (moves_others) continue;
    for (const Key& key : update.removed) bricks_.erase(key);
    merge(made.cells, update.changed);
    return update;
  }
}

}  // namespace isofield::engine
