#include "gpu/buffer.h"

#include <bit>

#include "gpu/buffer_impl.h"

namespace isofield::gpu {
namespace {

using Flags = vk::MemoryPropertyFlags;
using Flag = vk::MemoryPropertyFlagBits;

constexpr vk::BufferUsageFlags kUsage = vk::BufferUsageFlagBits::eStorageBuffer |
                                        vk::BufferUsageFlagBits::eUniformBuffer |
                                        vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;

// Returns the properties of memory that suit a use, the most wanted ones first.
std::vector<Flags> wishes(Buffer::Use use) {
  switch (use) {
    case Buffer::Use::kUpload:
      return {Flag::eHostVisible | Flag::eHostCoherent};
    case Buffer::Use::kReadback:
      return {Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached, Flag::eHostVisible | Flag::eHostCoherent};
    default:
      return {Flag::eDeviceLocal, Flags{}};
  }
}

std::optional<std::uint32_t> memory_type(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                         Buffer::Use use) {
  for (const Flags wish : wishes(use)) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((allowed >> i & 1) && (memory.memoryTypes[i].propertyFlags & wish) == wish) return i;
    }
  }
  return std::nullopt;
}

bool worth_mapping(const Device::Impl& device, Flags flags, Buffer::Use use) {
  const Flags visible = Flag::eHostVisible | Flag::eHostCoherent;
  if ((flags & visible) != visible) return false;
  if (use != Buffer::Use::kDevice) return true;
  return device.profile.maps_memory;
}

// Makes a Vulkan buffer of `bytes` with memory of its own, which is mapped if that is worth it.
absl::StatusOr<std::unique_ptr<Buffer::Impl>> make(Device::Impl& d, std::size_t bytes, Buffer::Use use) {
  auto impl = std::make_unique<Buffer::Impl>(d);
  impl->buffer.emplace(*d.device, vk::BufferCreateInfo({}, bytes, kUsage));
  const vk::MemoryRequirements needs = impl->buffer->getMemoryRequirements();
  const auto type = memory_type(d.memory, needs.memoryTypeBits, use);
  if (!type) return absl::InternalError("Vulkan offers no memory for a storage buffer");
  impl->memory.emplace(*d.device, vk::MemoryAllocateInfo(needs.size, *type));
  impl->buffer->bindMemory(**impl->memory, 0);
  if (worth_mapping(d, d.memory.memoryTypes[*type].propertyFlags, use)) {
    impl->mapped = static_cast<std::byte*>(impl->memory->mapMemory(0, VK_WHOLE_SIZE));
  }
  return impl;
}

}  // namespace

Buffer::Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
Buffer::~Buffer() = default;

void Buffer::Release::operator()(Impl* impl) const {
  std::unique_ptr<Impl> owned(impl);
  impl->device.allocated_bytes -= impl->size;
  if (impl->spares) impl->spares->give(std::move(owned));
}

absl::StatusOr<Buffer> Buffer::create(Device& device, std::size_t bytes, Use use) {
  Device::Impl& d = device.impl();
  const std::size_t size = std::max<std::size_t>((bytes + 15) / 16 * 16, 16);
  if (size > d.description.max_buffer_bytes) {
    return absl::ResourceExhaustedError(
        absl::StrCat("a buffer of ", size, " bytes; the device binds at most ", d.description.max_buffer_bytes));
  }
  const auto bits = std::max<std::uint32_t>(std::bit_width(size - 1), kLeastSpareBits);
  Spares<Impl>* const spares =
      bits <= kMostSpareBits ? &d.spare_buffers[static_cast<std::size_t>(use)][bits - kLeastSpareBits] : nullptr;
  try {
    std::unique_ptr<Impl> impl = spares ? spares->take() : nullptr;
    if (!impl) {
      absl::StatusOr<std::unique_ptr<Impl>> made = make(d, spares ? std::size_t{1} << bits : size, use);
      if (!made.ok()) return made.status();
      impl = *std::move(made);
    }
    impl->spares = spares;
    impl->size = size;
    d.allocated_bytes += size;
    return Buffer(std::move(impl));
  } catch (const vk::SystemError& error) {
    return to_status(error, "allocating a buffer");
  }
}

std::optional<Buffer> Buffer::borrow(Device& device, std::span<std::byte> bytes) {
  Device::Impl& d = device.impl();
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  if (d.borrow_alignment == 0 || bytes.empty() || address % kBorrowedAlignment != 0) {
    return std::nullopt;
  }
  // Vulkan imports whole pages. The buffer lies over the pages that hold the bytes, but kernels and copies use only the
  // bytes themselves.
  const std::uintptr_t first = address / d.borrow_alignment * d.borrow_alignment;
  const std::uintptr_t end =
      (address + bytes.size() + d.borrow_alignment - 1) / d.borrow_alignment * d.borrow_alignment;
  if (end - first > d.description.max_buffer_bytes) return std::nullopt;
  constexpr auto kHost = vk::ExternalMemoryHandleTypeFlagBits::eHostAllocationEXT;
  void* const pages = reinterpret_cast<void*>(first);
  try {
    auto impl = std::make_unique<Impl>(d);
    const vk::ExternalMemoryBufferCreateInfo external(kHost);
    impl->buffer.emplace(*d.device, vk::BufferCreateInfo({}, end - first, kUsage, {}, {}, {}, &external));
    const std::uint32_t allowed = impl->buffer->getMemoryRequirements().memoryTypeBits &
                                  d.device->getMemoryHostPointerPropertiesEXT(kHost, pages).memoryTypeBits;
    if (allowed == 0) return std::nullopt;
    const vk::ImportMemoryHostPointerInfoEXT import(kHost, pages);
    impl->memory.emplace(
        *d.device, vk::MemoryAllocateInfo(end - first, static_cast<std::uint32_t>(std::countr_zero(allowed)), &import));
    impl->buffer->bindMemory(**impl->memory, 0);
    impl->size = bytes.size();
    impl->offset = address - first;
    impl->mapped = bytes.data();
    d.allocated_bytes += impl->size;
    return Buffer(std::move(impl));
  } catch (const vk::SystemError&) {
    return std::nullopt;
  }
}

std::size_t Buffer::size() const {
  return impl_ ? impl_->size : 0;
}
std::byte* Buffer::data() const {
  return impl_ ? impl_->mapped : nullptr;
}

}  // namespace isofield::gpu
