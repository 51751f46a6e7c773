#include "engine/mesh/mesh_cache.h"

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

std::shared_ptr<const MeshCache::Kept> MeshCache::find(const ResidentScene& scene, const MeshRequest& request) {
  const base::MutexLock lock(mutex_);
  const Entry* const found = entries_.find(scene, [&](const Entry& e) { return e.request == request; });
  return found ? found->mesh : nullptr;
}

void MeshCache::keep(const ResidentScene& scene, const MeshRequest& request, Kept mesh) {
  const std::uint64_t bytes = bytes_of(mesh.parts);
  if (bytes > max_bytes_ / 2) return;
  const base::MutexLock lock(mutex_);
  entries_.add({scene.weak_from_this(), request, std::make_shared<const Kept>(std::move(mesh)), bytes});
  std::uint64_t sum = 0;
  entries_.trim([&](const Entry& e) { return (sum += e.bytes) <= max_bytes_; });
}

}  // namespace isofield::engine
