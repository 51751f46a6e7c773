// Private to this room: what a Device holds.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "base/mutex.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/spares.h"
#include "gpu/vulkan.h"

namespace isofield::gpu {

// Bindings of every pipeline: storage buffers 0 to kBindings - 1, uniform buffers from there on, and kPushBytes of push
// constants.
inline constexpr std::uint32_t kBindings = 16;
inline constexpr std::uint32_t kUniformBindings = 3;
inline constexpr std::uint32_t kPushBytes = 128;

// Small buffers are made in sizes of 2^n bytes and used again: from 2^kLeastSpareBits to 2^kMostSpareBits.
inline constexpr std::uint32_t kLeastSpareBits = 8, kMostSpareBits = 18;

// Of addresses of borrowed bytes: kernels read and write vec4s there.
inline constexpr std::size_t kBorrowedAlignment = 16;

struct Device::Impl {
  Impl();
  ~Impl();

  vk::raii::Context context;
  std::optional<vk::raii::Instance> instance;
  std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
  std::optional<vk::raii::PhysicalDevice> physical;
  std::optional<vk::raii::Device> device;
  std::optional<vk::raii::Queue> queue;
  base::Mutex queue_mutex;
  std::optional<Turns> turns;
  std::uint32_t queue_family = 0;
  std::optional<vk::raii::DescriptorSetLayout> set_layout;
  std::optional<vk::raii::PipelineLayout> pipeline_layout;
  vk::PhysicalDeviceMemoryProperties memory;

  DeviceDescription description;
  DeviceProfile profile;
  // What addresses and sizes of host memory that a buffer lies over are multiples of; 0: none does.
  std::size_t borrow_alignment = 0;
  std::function<void(const std::string&)> on_validation_message;
  std::atomic<std::uint64_t> validation_messages{0};
  std::atomic<std::uint64_t> allocated_bytes{0};

  // Last, and so gone before the device is.
  std::array<std::array<Spares<Buffer::Impl>, kMostSpareBits - kLeastSpareBits + 1>, 3>
      spare_buffers;  // by use and size
  Spares<Commands::Impl> spare_commands;
};

}  // namespace isofield::gpu
