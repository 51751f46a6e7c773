// The content of a Buffer. Only files in gpu/ may include this header, since it includes Vulkan.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device_impl.h"

namespace isofield::gpu {

struct Buffer::Impl {
  explicit Impl(Device::Impl& device) : device(device) {}

  Device::Impl& device;
  std::size_t size = 0;                    // bytes that the user may access; allocated_bytes counts them while in use
  Spares<Buffer::Impl>* spares = nullptr;  // takes the buffer after use; null: it is destroyed
  std::optional<vk::raii::Buffer> buffer;
  std::optional<vk::raii::DeviceMemory> memory;
  std::size_t offset = 0;       // the place of its first byte in `buffer`, which is not 0 for some borrowed bytes
  std::byte* mapped = nullptr;  // its first byte as the host sees it; null: not mapped
};

}  // namespace isofield::gpu
