#include "gpu/pipeline.h"

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/device_impl.h"
#include "gpu/pipeline_impl.h"

namespace isofield::gpu {
namespace {

// Makes the driver compile a pipeline now. A driver that runs kernels on the CPU may put the compilation off until the
// first dispatch. lavapipe does, and then compiles on the thread that serves all submissions, so a dispatch without
// workgroups is run here.
absl::Status compile_now(Device& device, const SharedPipeline& pipeline) {
  absl::StatusOr<Buffer> any = Buffer::create(device, kUniformAlignment, Buffer::Use::kDevice);
  if (!any.ok()) return any.status();
  absl::StatusOr<Commands> commands = Commands::begin(device);
  if (!commands.ok()) return commands.status();
  if (absl::Status s = commands->dispatch_nothing(pipeline, *any); !s.ok()) return s;
  if (absl::Status s = commands->submit(); !s.ok()) return s;
  return commands->wait();
}

}  // namespace

Pipeline::Pipeline(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Pipeline::~Pipeline() = default;

absl::StatusOr<SharedPipeline> Pipeline::create(Device& device, std::span<const std::uint32_t> spirv) {
  Device::Impl& d = device.impl();
  SharedPipeline pipeline;
  try {
    const vk::raii::ShaderModule module(*d.device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    pipeline.reset(new Pipeline(std::make_unique<Impl>(
        Impl{vk::raii::Pipeline(*d.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, **d.pipeline_layout))})));
  } catch (const vk::SystemError& error) {
    return to_status(error, "creating a pipeline");
  }
  if (device.profile().compiles_late) {
    if (absl::Status s = compile_now(device, pipeline); !s.ok()) return s;
  }
  return pipeline;
}

}  // namespace isofield::gpu
