// Private to this room: what a Buffer holds.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device_impl.h"

namespace isofield::gpu {

struct Buffer::Impl {
  Impl(Device::Impl& device, std::size_t size) : device(device), size(size) { device.allocated_bytes += size; }
  ~Impl() { device.allocated_bytes -= size; }

  Device::Impl& device;
  std::size_t size;
  std::optional<vk::raii::Buffer> buffer;
  std::optional<vk::raii::DeviceMemory> memory;
  std::byte* mapped = nullptr;
};

}  // namespace isofield::gpu
