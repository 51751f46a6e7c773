// The properties of a device as its Vulkan driver states them. They are shown to people, and device_profile.h derives
// the profile from them.
#pragma once

#include <cstdint>
#include <string>

namespace isofield::gpu {

struct DeviceDescription {
  std::string name, driver, vulkan_version;
  std::string type;  // "cpu", "integrated", "discrete", "virtual", "other"
  std::uint32_t subgroup_size = 0;
  std::uint64_t max_buffer_bytes = 0;  // the most bytes that one binding can hold
};

}  // namespace isofield::gpu
