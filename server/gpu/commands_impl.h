// Private to this room: what Commands hold.
#pragma once

#include <memory>
#include <vector>

#include "gpu/commands.h"
#include "gpu/device_impl.h"

namespace isofield::gpu {

struct Commands::Impl {
  explicit Impl(Device::Impl& device);
  vk::DescriptorSet next_set();
  // Until the device is done; at once when nothing was submitted.
  absl::Status wait();
  // Forgets what was recorded; the device must be done with it.
  void reset();

  Device::Impl& device;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer buffer;
  vk::raii::Fence fence;
  std::vector<vk::raii::DescriptorPool> set_pools;
  std::vector<SharedPipeline> pipelines;  // of the dispatches
  std::uint32_t sets_left = 0;  // in the last pool
  bool has_work = false;
  bool is_submitted = false;
  bool is_spent = false;  // submitted, whatever became of it
};

}  // namespace isofield::gpu
