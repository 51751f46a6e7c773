#include "gpu/gpu_environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

std::unique_ptr<gpu::Device> the_device;
std::unique_ptr<engine::KernelCache> the_kernels;

class GpuEnvironment : public testing::Environment {
 public:
  void SetUp() override {
    gpu::DeviceOptions options;
    // Machines without the validation layer can run the tests, too, but not by default.
    options.validation = std::getenv("ISOFIELD_TESTS_WITHOUT_VALIDATION") == nullptr;
    options.always_stage = std::getenv("ISOFIELD_TESTS_STAGE") != nullptr;
    if (const char* name = std::getenv("ISOFIELD_TESTS_DEVICE")) options.name = name;
    options.on_validation_message = [](const std::string& message) { std::cerr << "validation: " << message << "\n"; };
    auto device = gpu::Device::create(options);
    if (!device.ok()) {
      std::cerr << "no device for the GPU tests: " << device.status() << "\n";
      std::exit(1);
    }
    the_device = *std::move(device);
    // The tests need thousands of kernels. The specialised code is kept, so that one test process finds what another
    // has made.
    const char* const folder = std::getenv("ISOFIELD_TESTS_KERNELS");
    auto specialised = std::make_shared<engine::SpecialisedKernels>(folder ? folder : "");
    the_kernels = std::make_unique<engine::KernelCache>(
        *the_device, engine::KernelOptions{.most = 4096, .specialised = std::move(specialised)});
    std::cout << "device: " << the_device->description().name << ", subgroups of "
              << the_device->description().subgroup_size << (options.validation ? "" : ", WITHOUT VALIDATION") << "\n";
  }
  void TearDown() override {
    the_kernels.reset();
    EXPECT_EQ(the_device->allocated_bytes(), 0u) << "buffers outlive their owners";
    EXPECT_EQ(the_device->validation_messages(), 0u) << "the Vulkan validation layer has complained";
    the_device.reset();
  }
};

// GoogleTest owns the environment.
[[maybe_unused]] testing::Environment* const environment = testing::AddGlobalTestEnvironment(new GpuEnvironment);

}  // namespace

gpu::Device& device() {
  return *the_device;
}
engine::KernelCache& kernels() {
  return *the_kernels;
}

engine::VolumeCache& volumes() {
  static engine::VolumeCache cache(device(), kernels());
  return cache;
}

base::Workers& workers() {
  static base::Workers the_workers(2);
  return the_workers;
}

std::uint64_t scene_count(std::uint64_t many) {
  return std::getenv("ISOFIELD_TESTS_FEW_SCENES") ? std::min<std::uint64_t>(many, 2) : many;
}

bool few_kernels() {
  return std::getenv("ISOFIELD_TESTS_FEW_KERNELS") != nullptr;
}

engine::SceneLease resident(const v1::Scene& scene) {
  auto lease = engine::ResidentScene::create(device(), volumes(),
                                             test_support::compile_or_die(test_support::read_or_die(scene)));
  if (!lease.ok()) {
    std::cerr << lease.status() << "\n";
    std::exit(1);
  }
  return *std::move(lease);
}

}  // namespace isofield::gpu_test
