// Operators as volumes on the device ([G] section 4.3): built on first use, shared by all who use the same operator,
// gone with the last of them.
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

// (g, dg/df1, dg/df2, dg/dtheta) in float32 at size^3 nodes: shaders/lib/volume.glsl. Immutable; a shared_ptr to it is
// the lease under which kernels read.
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
  std::shared_ptr<const operators::SampledVolume> samples_;  // what it was made of, if not of a formula
};

using VolumeLease = std::shared_ptr<const Volume>;

// Thread-safe. A volume that two threads want is built once, and the second waits. Outlives no device; volumes may
// outlive the cache.
class VolumeCache {
 public:
  VolumeCache(gpu::Device& device, KernelCache& kernels) : device_(device), kernels_(kernels) {}

  // Of a Gradient with 16, 32, 64 or 128 samples a side, or of a Sampled. INVALID_ARGUMENT: any other.
  // RESOURCE_EXHAUSTED: no memory; a later call tries again.
  absl::StatusOr<VolumeLease> get(const operators::Operator& op);

  // Bytes of an operator's volume where somebody holds it, or 0.
  std::uint64_t resident_bytes(const operators::Operator& op) const;

  struct Usage {
    std::uint64_t volumes = 0, bytes = 0;
  };
  // Of the volumes in use now.
  Usage usage() const;

 private:
  // What a volume depends on; samples by a digest of their content.
  using Key = std::tuple<operators::Kind, operators::Silhouette, int, std::size_t>;
  struct Place {
    base::Mutex building;
    base::Mutex mutex;  // of `volume`, so that usage() waits for no builder
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
