// A compute pipeline: an entry point with its specialisation.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <span>

#include "gpu/device.h"

namespace isofield::gpu {

// Immutable after creation, so usable from any thread.
class Pipeline {
 public:
  // `constants` are the values of specialisation constants 0, 1, 2, ... The entry point is main.
  static absl::StatusOr<std::unique_ptr<Pipeline>> create(Device& device, std::span<const std::uint32_t> spirv,
                                                          std::span<const std::uint32_t> constants);
  ~Pipeline();

  struct Impl;  // gpu/pipeline_impl.h
  const Impl& impl() const { return *impl_; }

 private:
  explicit Pipeline(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield::gpu
