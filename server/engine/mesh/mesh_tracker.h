// Follows the mesh of a scene through its edits: what changes is made anew where supports that changed reach, and named
// by brick.
#pragma once

#include <absl/container/flat_hash_map.h>
#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/mesher.h"
#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// Leaves, of both scenes, outside of whose supports the two fields are the same bits; nothing: no such are known.
std::optional<std::vector<const blobtree::Leaf*>> changed_leaves(const ResidentScene& before,
                                                                 const ResidentScene& after);

// One thread.
class MeshTracker {
 public:
  // `request` has no part.
  MeshTracker(Mesher& mesher, const MeshRequest& request) : mesher_(mesher), request_(request) {}

  struct Update {
    bool is_whole = false;  // all that was known is void
    std::vector<std::array<std::uint32_t, 3>> removed;
    std::vector<MeshCells> changed;  // new ones, and those that take the place of others
  };
  // What leads from the mesh of the scene last given, or from none, to that of `scene`: to the same bytes as
  // Mesher::cells. After a failure the next update is whole.
  absl::StatusOr<Update> update(SceneLease scene, const MeshCallbacks& callbacks);

  // Of the mesh after the last update.
  std::uint64_t vertices() const;
  std::uint64_t triangles() const;

 private:
  // What a brick holds, by bytes: to compare.
  struct Content {
    std::string vertices, triangles;
    bool operator==(const Content&) const = default;
  };
  using Key = std::array<std::uint32_t, 3>;

  absl::StatusOr<Update> update_whole(const ResidentScene& scene, const MeshCallbacks& callbacks);
  // Of the bricks changed[part].
  absl::StatusOr<Update> update_part(const ResidentScene& scene, const std::vector<blobtree::BrickSet>& changed,
                                     std::size_t part, const MeshCallbacks& callbacks);
  // Notes what `cells` hold; what of it is new goes to `changed`.
  void merge(const MeshCells& cells, std::vector<MeshCells>& changed);

  Mesher& mesher_;
  const MeshRequest request_;
  SceneLease before_;
  absl::flat_hash_map<Key, Content> bricks_;
};

}  // namespace isofield::engine
