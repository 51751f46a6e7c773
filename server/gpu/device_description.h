// What a Vulkan driver says of its device.
#pragma once

#include <cstdint>
#include <string>

namespace isofield::gpu {

struct DeviceDescription {
  std::string name, driver, vulkan_version;
  std::string type;  // "cpu", "integrated", "discrete", "virtual", "other"
  std::uint32_t subgroup_size = 0;
  std::uint64_t max_buffer_bytes = 0;  // of one binding
};

}  // namespace isofield::gpu
