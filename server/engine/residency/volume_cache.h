// Keeps operators as volumes, 3-D tables of their values, on the device (Gourmel et al. 2013, section 4.3). A volume is
// built on first use, shared by all scenes that have the same operator, and freed with the last of them.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

#include "base/mutex.h"
#include "engine/kernels/kernel_cache.h"
#include "gpu/buffer.h"
#include "gpu/device.h"
#include "operators/operator.h"

namespace isofield::engine {

// A volume holds (g, dg/df1, dg/df2, dg/dtheta) in float32 at size^3 nodes (shaders/lib/volume.glsl). Immutable; a
// shared_ptr to it is the lease under which kernels read.
class Volume {
 public:
  const gpu::Buffer& buffer() const { return buffer_; }
  int size() const { return size_; }
  std::uint64_t bytes() const { return buffer_.size(); }

 private:
  friend class VolumeCache;
  Volume(gpu::Buffer buffer, int size, std::shared_ptr<const operators::SampledVolume> samples)
      : buffer_(std::move(buffer)), size_(size), samples_(std::move(samples)) {}

  gpu::Buffer buffer_;
  int size_;
  // The samples that the volume was made from; null if it was made from a formula.
  std::shared_ptr<const operators::SampledVolume> samples_;
};

using VolumeLease = std::shared_ptr<const Volume>;

// Thread-safe. A volume that two threads want at once is built once, and the second thread waits. The device must
// outlive the cache; volumes may outlive the cache.
class VolumeCache {
 public:
  VolumeCache(gpu::Device& device, KernelCache& kernels) : device_(device), kernels_(kernels) {}

  // Returns the volume of a Gradient with 16, 32, 64 or 128 samples a side, or of a Sampled operator. INVALID_ARGUMENT:
  // any other operator. RESOURCE_EXHAUSTED: no memory; a later call tries again.
  absl::StatusOr<VolumeLease> get(const operators::Operator& op);

  // Returns the bytes of the operator's volume, or 0 if nobody holds it.
  std::uint64_t resident_bytes(const operators::Operator& op) const;

  struct Usage {
    std::uint64_t volumes = 0, bytes = 0;
  };
  // Counts the volumes in use now, and their bytes.
  Usage usage() const;

 private:
  // Everything that a volume depends on; the last member is a digest of the samples, or 0 for a formula.
  using Key = std::tuple<operators::Kind, operators::Silhouette, int, std::size_t>;
  struct Place {
    base::Mutex building;
    base::Mutex mutex;  // guards `volume`; separate from `building`, so that usage() waits for no builder
    std::weak_ptr<const Volume> volume ABSL_GUARDED_BY(mutex);
    VolumeLease lease();
  };

  static absl::StatusOr<Key> key_of(const operators::Operator& op);
  std::shared_ptr<Place> place_of(const Key& key);
  absl::StatusOr<VolumeLease> build(const operators::Operator& op);

  gpu::Device& device_;
  KernelCache& kernels_;
  mutable base::Mutex mutex_;
  std::map<Key, std::shared_ptr<Place>> places_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::engine
