// The content of Commands. Only files in gpu/ may include this header, since it includes Vulkan.
#pragma once

#include <memory>
#include <vector>

#include "gpu/commands.h"
#include "gpu/device_impl.h"

namespace isofield::gpu {

struct Commands::Impl {
  explicit Impl(Device::Impl& device);
  // Returns a descriptor set for the next dispatch.
  vk::DescriptorSet next_set();
  // Waits until the device is done. Returns at once if nothing has been submitted.
  absl::Status wait();
  // Forgets what was recorded, so that the object can be used again. The device must be done with it.
  void reset();

  Device::Impl& device;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer buffer;
  vk::raii::Fence fence;
  std::vector<vk::raii::DescriptorPool> set_pools;
  std::vector<SharedPipeline> pipelines;  // those of the dispatches, kept alive until these are done
  std::uint32_t sets_left = 0;            // descriptor sets that the last pool still has
  bool has_work = false;
  bool is_submitted = false;  // submitted and not waited for
  bool is_spent = false;      // has been submitted, so that the fence must be reset before it is used again
};

}  // namespace isofield::gpu
