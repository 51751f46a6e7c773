#include "blobtree/tape/blend_edit.h"

#include <absl/container/flat_hash_map.h>

#include <memory>

#include "blobtree/scene/node_reader.h"
#include "blobtree/scene/profile_count.h"
#include "blobtree/tape/operation.h"

namespace isofield::blobtree {
absl::StatusOr<std::optional<Tape>> edit_blends(const Tape& tape, const v1::Scene& edited,
                                                const std::vector<std::uint32_t>& nodes, const SceneLimits& limits) {
  absl::flat_hash_map<std::uint32_t, std::shared_ptr<const operators::Operator>> changed;
  for (const std::uint32_t index : nodes) {
    const v1::Node& message = edited.nodes(static_cast<int>(index));
    if (!message.has_gradient() || message.gradient().volume() != 0) return std::nullopt;
    Node node;
    node.path = node_path(index, message);
    if (absl::Status s = read_node(message, {}, node); !s.ok()) return s;
    changed.emplace(index, node.op);
  }
  Tape result = tape;
  operators::SilhouetteBounds silhouettes;
  for (Operation& o : result.operations) {
    const auto it = changed.find(o.node);
    if (it == changed.end()) continue;
    Operation fresh = operation_of(it->second, operators::Law::kPositive, 2, silhouettes);
    if (fresh.op != o.op || fresh.what->form != o.what->form) return std::nullopt;
    o.what = std::move(fresh.what);
    o.growth = fresh.growth;
  }
  // If there are too many profiles, read_scene() must judge the whole scene.
  ProfileCount profiles;
  for (const Operation& o : result.operations) {
    if (o.what) profiles.add(*o.what);
  }
  if (profiles.size() > limits.max_profiles) return std::nullopt;
  return result;
}

}  // namespace isofield::blobtree
