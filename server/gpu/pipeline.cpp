#include "gpu/pipeline.h"

#include "gpu/device_impl.h"
#include "gpu/pipeline_impl.h"

namespace isofield::gpu {

Pipeline::Pipeline(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Pipeline::~Pipeline() = default;

absl::StatusOr<std::unique_ptr<Pipeline>> Pipeline::create(Device& device, std::span<const std::uint32_t> spirv,
                                                           std::span<const std::uint32_t> constants) {
  Device::Impl& d = device.impl();
  try {
    const vk::raii::ShaderModule module(*d.device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, 4 * i, 4);
    const vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                constants.size_bytes(), constants.data());
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialization);
    return std::unique_ptr<Pipeline>(new Pipeline(std::make_unique<Impl>(
        Impl{vk::raii::Pipeline(*d.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, **d.pipeline_layout))})));
  } catch (const vk::SystemError& error) {
    return to_status(error, "creating a pipeline");
  }
}

}  // namespace isofield::gpu
