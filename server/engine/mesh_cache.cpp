#include "engine/mesh_cache.h"

#include <algorithm>

namespace isofield::engine {
namespace {

std::uint64_t bytes_of(const MeshCache::Parts& parts) {
  std::uint64_t bytes = 0;
  for (const auto& p : parts) {
    bytes += p->bricks.size() * sizeof(MeshBrick) + 4 * (p->positions.size() + p->normals.size() + p->corners.size());
  }
  return bytes;
}

}  // namespace

std::shared_ptr<const MeshCache::Parts> MeshCache::find(const ResidentScene& scene, const MeshRequest& request) {
  const std::lock_guard lock(mutex_);
  entries_.remove_if([](const Entry& e) { return e.scene.expired(); });
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.request == request && e.scene.lock().get() == &scene; });
  if (it == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, it);
  return it->parts;
}

void MeshCache::keep(const ResidentScene& scene, const MeshRequest& request, Parts parts) {
  const std::uint64_t bytes = bytes_of(parts);
  if (bytes > max_bytes_ / 2) return;
  const std::lock_guard lock(mutex_);
  entries_.push_front({scene.weak_from_this(), request, std::make_shared<const Parts>(std::move(parts)), bytes});
  std::uint64_t sum = 0;
  entries_.remove_if([&](const Entry& e) { return e.scene.expired() || (sum += e.bytes) > max_bytes_; });
}

}  // namespace isofield::engine
