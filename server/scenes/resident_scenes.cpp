#include "scenes/resident_scenes.h"

#include <utility>

namespace isofield::scenes {

absl::StatusOr<engine::SceneLease> ResidentScenes::acquire(const catalog::Entry& entry) const {
  {
    const base::MutexLock lock(mutex_);
    const auto it = kept_.find(entry.version);
    if (it != kept_.end()) return it->second;
  }
  return engine_.make_resident(*entry.scene, entry.operators->table);
}

void ResidentScenes::keep(std::uint64_t version, engine::SceneLease scene) {
  const base::MutexLock lock(mutex_);
  kept_[version] = std::move(scene);
}

void ResidentScenes::drop(std::uint64_t version) {
  engine::SceneLease last;  // declared before the lock, so that the scene is freed after the lock is released
  const base::MutexLock lock(mutex_);
  const auto it = kept_.find(version);
  if (it == kept_.end()) return;
  last = std::move(it->second);
  kept_.erase(it);
}

ResidentScenes::Usage ResidentScenes::usage() const {
  const base::MutexLock lock(mutex_);
  Usage usage{kept_.size(), engine_.volumes().usage().bytes};
  for (const auto& [version, scene] : kept_) usage.bytes += scene->own_bytes();
  return usage;
}

}  // namespace isofield::scenes
