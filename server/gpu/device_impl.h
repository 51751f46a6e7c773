// The content of a Device. Only files in gpu/ may include this header, since it includes Vulkan.
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

// All pipelines have the same layout: storage buffers at the bindings 0 to kBindings - 1, kUniformBindings uniform
// buffers after them, and kPushBytes of push constants.
inline constexpr std::uint32_t kBindings = 16;
inline constexpr std::uint32_t kUniformBindings = 3;
inline constexpr std::uint32_t kPushBytes = 128;

// Small buffers have sizes of 2^n bytes, from 2^kLeastSpareBits to 2^kMostSpareBits, and are used again.
inline constexpr std::uint32_t kLeastSpareBits = 8, kMostSpareBits = 18;

// Addresses of borrowed bytes are multiples of this, since kernels read and write vec4s there.
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
  // A buffer over host memory begins and ends at multiples of this address; 0: the device does not borrow host memory.
  std::size_t borrow_alignment = 0;
  std::function<void(const std::string&)> on_validation_message;
  std::atomic<std::uint64_t> validation_messages{0};
  std::atomic<std::uint64_t> allocated_bytes{0};

  // These are the last members, so that they are destroyed before the Vulkan device.
  std::array<std::array<Spares<Buffer::Impl>, kMostSpareBits - kLeastSpareBits + 1>, 3>
      spare_buffers;  // by use, then by n of the size 2^n
  Spares<Commands::Impl> spare_commands;
};

}  // namespace isofield::gpu
