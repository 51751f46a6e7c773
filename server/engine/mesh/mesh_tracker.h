// MeshTracker follows the mesh of a scene through its edits. After an edit it makes anew only the bricks that the
// changed supports touch, and says which bricks have changed.
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

// Returns the leaves of both scenes that differ: outside their supports the two fields have the same bits. It returns
// nothing if the fields may differ anywhere.
std::optional<std::vector<const blobtree::Leaf*>> changed_leaves(const ResidentScene& before,
                                                                 const ResidentScene& after);

// Belongs to one thread. Keeps a lease of the last scene, and the bytes of its mesh.
class MeshTracker {
 public:
  // `request` must not ask for a part.
  MeshTracker(Mesher& mesher, const MeshRequest& request) : mesher_(mesher), request_(request) {}

  struct Update {
    bool is_whole = false;                              // true: all bricks of earlier updates are void
    std::vector<std::array<std::uint32_t, 3>> removed;  // x, y and z of the bricks that are empty now
    std::vector<MeshCells> changed;                     // new bricks, and bricks that replace older ones
  };
  // Returns the changes that lead from the mesh of the last scene, or from none, to that of `scene`. The result has the
  // same bytes as Mesher::cells() gives. Errors are those of Mesher; after one, the next update is whole.
  absl::StatusOr<Update> update(SceneLease scene, const MeshCallbacks& callbacks);

  // Return the size of the mesh after the last update.
  std::uint64_t vertices() const;
  std::uint64_t triangles() const;

 private:
  // The bytes of a brick's mesh, to be compared with later ones.
  struct Content {
    std::string vertices, triangles;
    bool operator==(const Content&) const = default;
  };
  using Key = std::array<std::uint32_t, 3>;

  absl::StatusOr<Update> update_whole(const ResidentScene& scene, const MeshCallbacks& callbacks);
  // Makes the bricks of changed[part] anew, with as many around them as have changed.
  absl::StatusOr<Update> update_part(const ResidentScene& scene, const std::vector<blobtree::BrickSet>& changed,
                                     std::size_t part, const MeshCallbacks& callbacks);
  // Notes the contents of `cells`, and appends the bricks that have changed to `changed`.
  void merge(const MeshCells& cells, std::vector<MeshCells>& changed);

  Mesher& mesher_;
  const MeshRequest request_;
  SceneLease before_;
  absl::flat_hash_map<Key, Content> bricks_;
};

}  // namespace isofield::engine
