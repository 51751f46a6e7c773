// Keeps scenes of the catalog resident on the device, so that requests find them there.
#pragma once

#include <absl/container/flat_hash_map.h>
#include <absl/status/statusor.h>

#include <cstdint>

#include "base/mutex.h"
#include "catalog/catalog.h"
#include "engine/engine.h"

namespace isofield::scenes {

// Owns a lease of each version that is to stay resident. Thread-safe.
class ResidentScenes {
 public:
  explicit ResidentScenes(engine::Engine& engine) : engine_(engine) {}

  // Returns the resident form of an entry, and makes it for the caller alone if it is not kept. Errors are those of
  // engine::Engine::make_resident.
  absl::StatusOr<engine::SceneLease> acquire(const catalog::Entry& entry) const;

  // Keeps a version for acquire() until drop(). A lease that acquire() has returned stays valid after drop().
  void keep(std::uint64_t version, engine::SceneLease scene);
  void drop(std::uint64_t version);

  struct Usage {
    std::uint64_t scenes = 0, bytes = 0;  // bytes on the device, including those of all volumes
  };
  Usage usage() const;

 private:
  engine::Engine& engine_;
  mutable base::Mutex mutex_;
  absl::flat_hash_map<std::uint64_t, engine::SceneLease> kept_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::scenes
