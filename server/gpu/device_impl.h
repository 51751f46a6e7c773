// Private to this room: what a Device holds.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

#include "gpu/device.h"
#include "gpu/vulkan.h"

namespace isofield::gpu {

// Bindings of every pipeline: storage buffers 0 to kBindings - 1, uniform buffers from there on, and kPushBytes of push
// constants.
inline constexpr std::uint32_t kBindings = 16;
inline constexpr std::uint32_t kUniformBindings = 3;
inline constexpr std::uint32_t kPushBytes = 128;

struct Device::Impl {
  vk::raii::Context context;
  std::optional<vk::raii::Instance> instance;
  std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
  std::optional<vk::raii::PhysicalDevice> physical;
  std::optional<vk::raii::Device> device;
  std::optional<vk::raii::Queue> queue;
  std::mutex queue_mutex;
  std::uint32_t queue_family = 0;
  std::optional<vk::raii::DescriptorSetLayout> set_layout;
  std::optional<vk::raii::PipelineLayout> pipeline_layout;
  vk::PhysicalDeviceMemoryProperties memory;

  DeviceDescription description;
  bool always_stage = false;
  std::function<void(const std::string&)> on_validation_message;
  std::atomic<std::uint64_t> validation_messages{0};
  std::atomic<std::uint64_t> allocated_bytes{0};
};

}  // namespace isofield::gpu
