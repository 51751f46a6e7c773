// Private to this room: what a Buffer holds.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device_impl.h"

namespace isofield::gpu {

struct Buffer::Impl {
  explicit Impl(Device::Impl& device) : device(device) {}

  Device::Impl& device;
  std::size_t size = 0;                    // of which the device counts that of buffers in use
  Spares<Buffer::Impl>* spares = nullptr;  // where it goes after use; null: nowhere
  std::optional<vk::raii::Buffer> buffer;
  std::optional<vk::raii::DeviceMemory> memory;
  std::size_t offset = 0;  // of its bytes in `buffer`
  std::byte* mapped = nullptr;
};

}  // namespace isofield::gpu
