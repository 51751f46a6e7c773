// Measures filtered fetches from a 3-D texture of four float32 channels. The papers (Gourmel et al. 2013, section 4.2)
// keep g and its partials in such a texture, so the cost of a computed g is compared with this.
#include <benchmark/benchmark.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>
#define VULKAN_HPP_NO_SPACESHIP_OPERATOR
#include <vulkan/vulkan_raii.hpp>

#include "support/random_scene.h"

namespace isofield {
namespace {

#include "texture_fetch.inc"

constexpr std::uint32_t kCount = 1 << 20;

std::uint32_t memory_type(const vk::raii::PhysicalDevice& physical, std::uint32_t allowed,
                          vk::MemoryPropertyFlags wanted) {
  const auto memory = physical.getMemoryProperties();
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  throw std::runtime_error("no such memory");
}

// Owns a device, a texture of size^3 and the kernel that fetches from it.
class Fetches {
 public:
  explicit Fetches(std::uint32_t size) : size_(size) {
    fill(places_, 3);
    make_image();
    bind();
    run([&] { upload(); });
  }

  // Fetches kCount times.
  void fetch() {
    run([&] {
      commands_.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
      commands_.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *set_, {});
      commands_.dispatch(kCount / 64, 1, 1);
    });
  }

 private:
  struct Buffer {
    Buffer(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device, std::size_t bytes)
        : buffer(device, {{}, bytes, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc}),
          memory(device,
                 {buffer.getMemoryRequirements().size,
                  memory_type(physical, buffer.getMemoryRequirements().memoryTypeBits,
                              vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent)}),
          size(bytes) {
      buffer.bindMemory(*memory, 0);
    }
    vk::raii::Buffer buffer;
    vk::raii::DeviceMemory memory;
    std::size_t size;
  };

  static void fill(Buffer& buffer, std::uint64_t seed) {
    test_support::Random random(seed);
    auto* const numbers = static_cast<float*>(buffer.memory.mapMemory(0, buffer.size));
    for (std::size_t i = 0; i < buffer.size / sizeof(float); ++i) numbers[i] = static_cast<float>(random.number(0, 1));
    buffer.memory.unmapMemory();
  }

  void make_image() {
    using Usage = vk::ImageUsageFlagBits;
    constexpr auto kFormat = vk::Format::eR32G32B32A32Sfloat;
    image_ = vk::raii::Image(device_, vk::ImageCreateInfo({}, vk::ImageType::e3D, kFormat, {size_, size_, size_}, 1, 1,
                                                          vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
                                                          Usage::eSampled | Usage::eTransferDst));
    const auto needs = image_.getMemoryRequirements();
    image_memory_ = vk::raii::DeviceMemory(device_, {needs.size, memory_type(physical_, needs.memoryTypeBits, {})});
    image_.bindMemory(*image_memory_, 0);
    view_ = vk::raii::ImageView(device_, {{}, *image_, vk::ImageViewType::e3D, kFormat, {}, kWhole});
    constexpr auto kEdge = vk::SamplerAddressMode::eClampToEdge;
    sampler_ = vk::raii::Sampler(
        device_, {{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest, kEdge, kEdge, kEdge});
  }

  void bind() {
    using Type = vk::DescriptorType;
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const Type type : {Type::eCombinedImageSampler, Type::eStorageBuffer, Type::eStorageBuffer}) {
      bindings.emplace_back(static_cast<std::uint32_t>(bindings.size()), type, 1, vk::ShaderStageFlagBits::eCompute);
    }
    set_layout_ = vk::raii::DescriptorSetLayout(device_, {{}, bindings});
    layout_ = vk::raii::PipelineLayout(device_, {{}, *set_layout_});
    const vk::raii::ShaderModule module(device_, {{}, sizeof(texture_fetch), texture_fetch});
    pipeline_ =
        vk::raii::Pipeline(device_, nullptr, {{}, {{}, vk::ShaderStageFlagBits::eCompute, *module, "main"}, *layout_});
    const std::array sizes{vk::DescriptorPoolSize(Type::eCombinedImageSampler, 1),
                           vk::DescriptorPoolSize(Type::eStorageBuffer, 2)};
    set_pool_ = vk::raii::DescriptorPool(device_, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    set_ = std::move(vk::raii::DescriptorSets(device_, {*set_pool_, *set_layout_}).front());
    const vk::DescriptorImageInfo texture(*sampler_, *view_, vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::DescriptorBufferInfo places(*places_.buffer, 0, VK_WHOLE_SIZE),
        results(*results_.buffer, 0, VK_WHOLE_SIZE);
    device_.updateDescriptorSets({{*set_, 0, 0, 1, Type::eCombinedImageSampler, &texture},
                                  {*set_, 1, 0, 1, Type::eStorageBuffer, nullptr, &places},
                                  {*set_, 2, 0, 1, Type::eStorageBuffer, nullptr, &results}},
                                 {});
  }

  void upload() {
    staging_.emplace(physical_, device_, std::size_t{16} * size_ * size_ * size_);
    fill(*staging_, 4);
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const auto change = [&](Access from, Access to, vk::ImageLayout before, vk::ImageLayout after) {
      commands_.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands, {}, {}, {},
                                vk::ImageMemoryBarrier(from, to, before, after, VK_QUEUE_FAMILY_IGNORED,
                                                       VK_QUEUE_FAMILY_IGNORED, *image_, kWhole));
    };
    change({}, Access::eTransferWrite, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    commands_.copyBufferToImage(
        *staging_->buffer, *image_, vk::ImageLayout::eTransferDstOptimal,
        vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {size_, size_, size_}));
    change(Access::eTransferWrite, Access::eShaderRead, vk::ImageLayout::eTransferDstOptimal,
           vk::ImageLayout::eShaderReadOnlyOptimal);
  }

  template <class Record>
  void run(const Record& record) {
    commands_.begin(vk::CommandBufferBeginInfo{});
    record();
    commands_.end();
    const vk::CommandBuffer commands = *commands_;
    queue_.submit(vk::SubmitInfo({}, {}, commands));
    queue_.waitIdle();
  }

  static constexpr vk::ImageSubresourceRange kWhole{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};

  std::uint32_t size_;
  vk::raii::Context context_;
  const vk::ApplicationInfo application_{"isofield_bench", 1, nullptr, 0, VK_API_VERSION_1_1};
  vk::raii::Instance instance_{context_, vk::InstanceCreateInfo({}, &application_)};
  vk::raii::PhysicalDevice physical_{std::move(vk::raii::PhysicalDevices(instance_).front())};
  const float priority_ = 1;
  const vk::DeviceQueueCreateInfo queue_info_{{}, 0, 1, &priority_};  // lavapipe's one family
  vk::raii::Device device_{physical_, vk::DeviceCreateInfo({}, queue_info_)};
  vk::raii::Queue queue_{device_, 0, 0};
  vk::raii::CommandPool pool_{device_, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0}};
  vk::raii::CommandBuffer commands_{
      std::move(vk::raii::CommandBuffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1}).front())};
  Buffer places_{physical_, device_, std::size_t{16} * kCount}, results_{physical_, device_, std::size_t{16} * kCount};
  std::optional<Buffer> staging_;
  vk::raii::Image image_ = nullptr;
  vk::raii::DeviceMemory image_memory_ = nullptr;
  vk::raii::ImageView view_ = nullptr;
  vk::raii::Sampler sampler_ = nullptr;
  vk::raii::DescriptorSetLayout set_layout_ = nullptr;
  vk::raii::PipelineLayout layout_ = nullptr;
  vk::raii::Pipeline pipeline_ = nullptr;
  vk::raii::DescriptorPool set_pool_ = nullptr;
  vk::raii::DescriptorSet set_ = nullptr;
};

void fetch(benchmark::State& state, std::uint32_t size) {
  Fetches fetches(size);
  for (auto _ : state) fetches.fetch();
  state.counters["look-ups/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kCount, benchmark::Counter::kIsRate);
}

[[maybe_unused]] const bool is_registered = [] {
  for (const std::uint32_t size : {16u, 64u, 128u}) {
    const std::string cube = std::to_string(size) + "^3";
    benchmark::RegisterBenchmark(("operator/texture/fetch " + cube).c_str(),
                                 [size](benchmark::State& s) { fetch(s, size); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->MeasureProcessCPUTime()
        ->MinWarmUpTime(0.01);
  }
  return true;
}();

}  // namespace
}  // namespace isofield
