// The scenes of the catalog that are resident on the device.
#pragma once

#include <absl/container/flat_hash_map.h>
#include <absl/status/statusor.h>

#include <cstdint>

#include "base/mutex.h"
#include "catalog/catalog.h"
#include "engine/engine.h"

namespace isofield::scenes {

// Keeps a lease of each version that is to stay resident. Thread-safe.
class ResidentScenes {
 public:
  explicit ResidentScenes(engine::Engine& engine) : engine_(engine) {}

  // Returns the resident form of an entry, which is made now if it is not kept. Errors are those of
  // engine::Engine::make_resident.
  absl::StatusOr<engine::SceneLease> acquire(const catalog::Entry& entry) const;

  // Keeps a version for acquire() until drop(); leases that are out live on.
  void keep(std::uint64_t version, engine::SceneLease scene);
  void drop(std::uint64_t version);

  struct Usage {
    std::uint64_t scenes = 0, bytes = 0;  // bytes on the device, those of volumes included
  };
  Usage usage() const;

 private:
  engine::Engine& engine_;
  mutable base::Mutex mutex_;
  absl::flat_hash_map<std::uint64_t, engine::SceneLease> kept_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::scenes
