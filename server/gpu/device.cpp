#include "gpu/device.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <thread>

#include "gpu/buffer_impl.h"
#include "gpu/commands_impl.h"
#include "gpu/device_impl.h"
#include "gpu/device_selection.h"

namespace isofield::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto* impl = static_cast<Device::Impl*>(user);
  ++impl->validation_messages;
  if (impl->on_validation_message) impl->on_validation_message(data->pMessage);
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(Device::Impl* impl) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {{},
          Severity::eWarning | Severity::eError,
          Type::eGeneral | Type::eValidation | Type::ePerformance,
          on_message,
          impl};
}

absl::Status create_instance(const DeviceOptions& options, Device::Impl& impl) {
  const vk::ApplicationInfo application("isofield", 1, "isofield", 1, VK_API_VERSION_1_1);
  std::vector<const char*> layers, extensions;
  vk::InstanceCreateInfo info({}, &application);
  const vk::DebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&impl);
  if (options.validation) {
    bool found = false;
    for (const auto& layer : impl.context.enumerateInstanceLayerProperties()) {
      found |= std::strcmp(layer.layerName, kValidationLayer) == 0;
    }
    if (!found) {
      return absl::NotFoundError(
          absl::StrCat("no ", kValidationLayer, "; install it, for example Debian's vulkan-validationlayers"));
    }
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.setPNext(&messenger);
  }
  info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
  impl.instance.emplace(impl.context, info);
  if (options.validation) impl.messenger.emplace(*impl.instance, messenger);
  return absl::OkStatus();
}

DeviceCandidate::Type type_of(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return DeviceCandidate::Type::kDiscrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return DeviceCandidate::Type::kIntegrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return DeviceCandidate::Type::kVirtual;
    case vk::PhysicalDeviceType::eCpu:
      return DeviceCandidate::Type::kCpu;
    default:
      return DeviceCandidate::Type::kOther;
  }
}

const char* name_of(DeviceCandidate::Type type) {
  switch (type) {
    case DeviceCandidate::Type::kDiscrete:
      return "discrete";
    case DeviceCandidate::Type::kIntegrated:
      return "integrated";
    case DeviceCandidate::Type::kVirtual:
      return "virtual";
    case DeviceCandidate::Type::kCpu:
      return "cpu";
    default:
      return "other";
  }
}

std::optional<std::uint32_t> compute_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  }
  return std::nullopt;
}

// Returns the value of Device::Impl::borrow_alignment for a device: 0 if it cannot use the host's memory.
std::size_t borrow_alignment(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  const auto extensions = device.enumerateDeviceExtensionProperties();
  const bool borrows = properties.limits.minStorageBufferOffsetAlignment <= kBorrowedAlignment &&
                       std::any_of(extensions.begin(), extensions.end(), [](const vk::ExtensionProperties& e) {
                         return std::string_view(e.extensionName) == VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME;
                       });
  if (!borrows) return 0;
  using Limits = vk::PhysicalDeviceExternalMemoryHostPropertiesEXT;
  return device.getProperties2<vk::PhysicalDeviceProperties2, Limits>().get<Limits>().minImportedHostPointerAlignment;
}

bool has_subgroup_operations(const vk::raii::PhysicalDevice& device) {
  using Feature = vk::SubgroupFeatureFlagBits;
  constexpr vk::SubgroupFeatureFlags kNeeded = Feature::eBasic | Feature::eVote | Feature::eShuffle;
  const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
  const auto& subgroups = chain.get<vk::PhysicalDeviceSubgroupProperties>();
  return (subgroups.supportedOperations & kNeeded) == kNeeded &&
         (subgroups.supportedStages & vk::ShaderStageFlagBits::eCompute);
}

DeviceCandidate candidate(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  DeviceCandidate c;
  c.name = properties.deviceName.data();
  c.type = type_of(properties.deviceType);
  c.api_major = VK_API_VERSION_MAJOR(properties.apiVersion);
  c.api_minor = VK_API_VERSION_MINOR(properties.apiVersion);
  c.has_compute_queue = compute_family(device).has_value();
  c.storage_buffers_per_stage = properties.limits.maxPerStageDescriptorStorageBuffers;
  c.uniform_bytes = properties.limits.maxUniformBufferRange;
  c.workgroup_invocations = properties.limits.maxComputeWorkGroupInvocations;
  // A device of Vulkan 1.0 cannot be asked about subgroups. It is refused for its version.
  c.has_subgroup_operations = properties.apiVersion >= VK_API_VERSION_1_1 && has_subgroup_operations(device);
  return c;
}

absl::Status pick_physical(const DeviceOptions& options, Device::Impl& impl) {
  vk::raii::PhysicalDevices devices(*impl.instance);
  std::vector<DeviceCandidate> candidates;
  for (const auto& device : devices) candidates.push_back(candidate(device));
  absl::StatusOr<std::size_t> choice = select_device(candidates, options.name);
  if (!choice.ok()) return choice.status();
  impl.physical.emplace(std::move(devices[*choice]));

  const auto chain = impl.physical->getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties,
                                                   vk::PhysicalDeviceDriverProperties>();
  const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  DeviceDescription& d = impl.description;
  d.name = properties.deviceName.data();
  d.driver = absl::StrCat(driver.driverName.data(), " ", driver.driverInfo.data());
  d.vulkan_version =
      absl::StrCat(VK_API_VERSION_MAJOR(properties.apiVersion), ".", VK_API_VERSION_MINOR(properties.apiVersion), ".",
                   VK_API_VERSION_PATCH(properties.apiVersion));
  d.type = name_of(candidates[*choice].type);
  d.subgroup_size = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
  d.max_buffer_bytes = properties.limits.maxStorageBufferRange;
  return absl::OkStatus();
}

void choose_profile(const DeviceOptions& options, Device::Impl& impl) {
  DeviceProfile& profile = impl.profile;
  profile = profile_of(impl.description, std::thread::hardware_concurrency());
  if (options.always_stage) profile.maps_memory = profile.borrows_memory = false;
  if (profile.borrows_memory) impl.borrow_alignment = borrow_alignment(*impl.physical);
  profile.borrows_memory = impl.borrow_alignment > 0;
  impl.turns.emplace(profile.patience);
}

void create_device(Device::Impl& impl) {
  impl.queue_family = *compute_family(*impl.physical);
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, impl.queue_family, 1, &priority);
  std::vector<const char*> extensions;
  if (impl.borrow_alignment > 0) extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  impl.device.emplace(*impl.physical, vk::DeviceCreateInfo({}, queue, {}, extensions));
  impl.queue.emplace(*impl.device, impl.queue_family, 0);
  impl.memory = impl.physical->getMemoryProperties();

  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < kBindings + kUniformBindings; ++i) {
    const auto type = i < kBindings ? vk::DescriptorType::eStorageBuffer : vk::DescriptorType::eUniformBuffer;
    bindings.emplace_back(i, type, 1, vk::ShaderStageFlagBits::eCompute);
  }
  impl.set_layout.emplace(*impl.device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
  const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, kPushBytes);
  impl.pipeline_layout.emplace(*impl.device, vk::PipelineLayoutCreateInfo({}, **impl.set_layout, range));
}

}  // namespace

Device::Impl::Impl() = default;
Device::Impl::~Impl() = default;
Device::Device(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Device::~Device() = default;

absl::StatusOr<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
  try {
    std::unique_ptr<Impl> impl;
    try {
      impl = std::make_unique<Impl>();
    } catch (const std::runtime_error& error) {
      // Vulkan-Hpp throws this if it cannot open Vulkan's library.
      return absl::NotFoundError(absl::StrCat("no Vulkan: ", error.what()));
    }
    impl->on_validation_message = options.on_validation_message;
    if (absl::Status s = create_instance(options, *impl); !s.ok()) return s;
    if (absl::Status s = pick_physical(options, *impl); !s.ok()) return s;
    choose_profile(options, *impl);
    create_device(*impl);
    return std::unique_ptr<Device>(new Device(std::move(impl)));
  } catch (const vk::SystemError& error) {
    return to_status(error, "opening the device");
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError("opening the device: out of memory");
  } catch (const std::exception& error) {
    return absl::InternalError(absl::StrCat("opening the device: ", error.what()));
  }
}

const DeviceDescription& Device::description() const {
  return impl_->description;
}
const DeviceProfile& Device::profile() const {
  return impl_->profile;
}
std::uint64_t Device::validation_messages() const {
  return impl_->validation_messages;
}
std::uint64_t Device::allocated_bytes() const {
  return impl_->allocated_bytes;
}
Turns& Device::turns() {
  return *impl_->turns;
}

}  // namespace isofield::gpu
