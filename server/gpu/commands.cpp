#include "gpu/commands.h"

#include <algorithm>
#include <array>

#include "gpu/buffer_impl.h"
#include "gpu/commands_impl.h"
#include "gpu/pipeline_impl.h"

namespace isofield::gpu {
namespace {

constexpr std::uint32_t kSetsPerPool = 64;

}  // namespace

Commands::Impl::Impl(Device::Impl& d)
    : device(d),
      pool(*d.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, d.queue_family)),
      buffer(std::move(vk::raii::CommandBuffers(*d.device, {*pool, vk::CommandBufferLevel::ePrimary, 1}).front())),
      fence(*d.device, vk::FenceCreateInfo()) {}

vk::DescriptorSet Commands::Impl::next_set() {
  if (sets_left == 0) {
    const std::array sizes{vk::DescriptorPoolSize(vk::DescriptorType::eStorageBuffer, kSetsPerPool * kBindings),
                           vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, kSetsPerPool * kUniformBindings)};
    set_pools.emplace_back(*device.device, vk::DescriptorPoolCreateInfo({}, kSetsPerPool, sizes));
    sets_left = kSetsPerPool;
  }
  --sets_left;
  // Descriptor sets are freed with their pool, so nothing owns this one.
  return (*device.device).allocateDescriptorSets({*set_pools.back(), **device.set_layout}).front().release();
}

void Commands::Impl::reset() {
  pool.reset();
  if (is_spent) device.device->resetFences(*fence);
  is_spent = has_work = false;
  pipelines.clear();
  if (set_pools.empty()) return;
  set_pools.erase(set_pools.begin() + 1, set_pools.end());
  set_pools.front().reset();
  sets_left = kSetsPerPool;
}

Commands::Commands(Commands&&) noexcept = default;
Commands& Commands::operator=(Commands&&) noexcept = default;
Commands::~Commands() = default;

void Commands::Release::operator()(Impl* impl) const {
  std::unique_ptr<Impl> owned(impl);
  if (!owned->wait().ok()) return;
  try {
    owned->reset();
    Device::Impl& device = owned->device;
    device.spare_commands.give(std::move(owned));
  } catch (const vk::SystemError&) {
    // The object is then destroyed instead of being kept.
  }
}

absl::StatusOr<Commands> Commands::begin(Device& device) {
  try {
    std::unique_ptr<Impl> impl = device.impl().spare_commands.take();
    if (!impl) impl = std::make_unique<Impl>(device.impl());
    impl->buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    return Commands(std::move(impl));
  } catch (const vk::SystemError& error) {
    return to_status(error, "beginning commands");
  }
}

absl::Status Commands::dispatch(const SharedPipeline& pipeline, const Bindings& bindings,
                                std::span<const std::byte> push_constants, std::uint32_t groups) {
  if (groups == 0) return absl::OkStatus();
  if (groups > kMaxGroups) return absl::InternalError(absl::StrCat("a dispatch of ", groups, " workgroups"));
  return record(pipeline, bindings, push_constants, groups);
}

absl::Status Commands::dispatch_nothing(const SharedPipeline& pipeline, const Buffer& any) {
  return record(pipeline, {{0, &any}}, std::vector<std::byte>(kPushBytes), 0);
}

absl::Status Commands::record(const SharedPipeline& pipeline, const Bindings& bindings,
                              std::span<const std::byte> push_constants, std::uint32_t groups) {
  try {
    const vk::DescriptorSet set = impl_->next_set();
    std::vector<vk::DescriptorBufferInfo> infos;
    std::vector<vk::WriteDescriptorSet> writes;
    infos.reserve(kBindings + kUniformBindings);
    const auto bind = [&](std::uint32_t binding, const Buffer& buffer, std::size_t offset) {
      const bool is_uniform = binding >= kBindings;
      const vk::DeviceSize left = buffer.size() - offset;
      infos.emplace_back(**buffer.impl().buffer, buffer.impl().offset + offset,
                         is_uniform ? std::min<vk::DeviceSize>(left, kUniformBytes) : left);
      writes.emplace_back(set, binding, 0, 1,
                          is_uniform ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer, nullptr,
                          &infos.back());
    };
    std::uint32_t named = 0;
    for (const Binding& b : bindings) {
      bind(b.binding, *b.buffer, b.offset);
      named |= 1u << b.binding;
    }
    // Vulkan requires a buffer at every binding that the module declares, even if its specialisation never reads it.
    for (std::uint32_t binding = 0; binding < kBindings + kUniformBindings && !bindings.empty(); ++binding) {
      if (!(named >> binding & 1u)) bind(binding, *bindings.front().buffer, 0);
    }
    impl_->device.device->updateDescriptorSets(writes, {});
    const vk::raii::CommandBuffer& b = impl_->buffer;
    b.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline->impl().pipeline);
    b.bindDescriptorSets(vk::PipelineBindPoint::eCompute, **impl_->device.pipeline_layout, 0, set, {});
    b.pushConstants<std::byte>(**impl_->device.pipeline_layout, vk::ShaderStageFlagBits::eCompute, 0,
                               vk::ArrayProxy<const std::byte>(push_constants.size(), push_constants.data()));
    b.dispatch(groups, 1, 1);
    if (impl_->pipelines.empty() || impl_->pipelines.back() != pipeline) impl_->pipelines.push_back(pipeline);
    impl_->has_work = true;
    return absl::OkStatus();
  } catch (const vk::SystemError& error) {
    return to_status(error, "recording a dispatch");
  }
}

void Commands::barrier() {
  using Access = vk::AccessFlagBits;
  using Stage = vk::PipelineStageFlagBits;
  const vk::MemoryBarrier all(
      Access::eShaderWrite | Access::eTransferWrite,
      Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead | Access::eTransferWrite | Access::eHostRead);
  impl_->buffer.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer,
                                Stage::eComputeShader | Stage::eTransfer | Stage::eHost, {}, all, {}, {});
}

void Commands::copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset,
                    std::size_t bytes) {
  impl_->buffer.copyBuffer(**from.impl().buffer, **to.impl().buffer,
                           vk::BufferCopy(from.impl().offset + from_offset, to.impl().offset + to_offset, bytes));
  impl_->has_work = true;
}

void Commands::fill_zero(const Buffer& buffer) {
  impl_->buffer.fillBuffer(**buffer.impl().buffer, buffer.impl().offset, buffer.size(), 0);
  impl_->has_work = true;
}

bool Commands::has_work() const {
  return impl_->has_work;
}

absl::Status Commands::submit() {
  try {
    barrier();
    impl_->buffer.end();
    const vk::CommandBuffer buffer = *impl_->buffer;
    const base::MutexLock lock(impl_->device.queue_mutex);
    impl_->device.queue->submit(vk::SubmitInfo({}, {}, buffer), *impl_->fence);
    impl_->is_submitted = impl_->is_spent = true;
    return absl::OkStatus();
  } catch (const vk::SystemError& error) {
    return to_status(error, "submitting commands");
  }
}

absl::Status Commands::wait() {
  return impl_->wait();
}

absl::Status Commands::Impl::wait() {
  if (!is_submitted) return absl::OkStatus();
  try {
    const vk::Result result = device.device->waitForFences(*fence, true, ~std::uint64_t{0});
    is_submitted = false;
    return result == vk::Result::eSuccess ? absl::OkStatus()
                                          : absl::InternalError("Vulkan: waiting for a fence failed");
  } catch (const vk::SystemError& error) {
    return to_status(error, "waiting for the device");
  }
}

}  // namespace isofield::gpu
