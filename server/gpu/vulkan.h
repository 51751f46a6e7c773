// Includes Vulkan-Hpp, and turns its exceptions into statuses. Only files in gpu/ may include this header.
#pragma once

#include <absl/status/status.h>
#include <absl/strings/str_cat.h>

#define VULKAN_HPP_NO_SPACESHIP_OPERATOR
#include <vulkan/vulkan_raii.hpp>

namespace isofield::gpu {

// RESOURCE_EXHAUSTED if the device or the host is out of memory, NOT_FOUND if no driver is installed, else INTERNAL,
// such as for a lost device. `doing` says what has failed, as in "creating a pipeline".
inline absl::Status to_status(const vk::SystemError& error, const char* doing) {
  const std::string text = absl::StrCat("Vulkan, ", doing, ": ", error.what());
  const auto code = static_cast<vk::Result>(error.code().value());
  if (code == vk::Result::eErrorOutOfDeviceMemory || code == vk::Result::eErrorOutOfHostMemory) {
    return absl::ResourceExhaustedError(text);
  }
  if (code == vk::Result::eErrorIncompatibleDriver) {
    return absl::NotFoundError(
        absl::StrCat(text, "; install a driver of Vulkan, for example Debian's mesa-vulkan-drivers"));
  }
  return absl::InternalError(text);
}

}  // namespace isofield::gpu
