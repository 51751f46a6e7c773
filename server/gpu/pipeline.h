// A compute pipeline is a kernel that the driver has compiled, ready to be dispatched.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <span>

#include "gpu/device.h"

namespace isofield::gpu {

class Pipeline;
using SharedPipeline = std::shared_ptr<const Pipeline>;

// Owns the compiled kernel. It never changes, so any thread may use it.
class Pipeline {
 public:
  // Makes a pipeline of a SPIR-V module, whose entry point is main. The driver has compiled it when this returns.
  static absl::StatusOr<SharedPipeline> create(Device& device, std::span<const std::uint32_t> spirv);
  ~Pipeline();

  struct Impl;  // gpu/pipeline_impl.h
  const Impl& impl() const { return *impl_; }

 private:
  explicit Pipeline(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield::gpu
