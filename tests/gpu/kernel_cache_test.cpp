// Tests that kernels are specialised before the driver sees them, kept while they are used, and compiled ahead of
// edits.
#include "engine/kernels/kernel_cache.h"

#include <gtest/gtest.h>

#include <array>
#include <barrier>
#include <iterator>
#include <spirv-tools/libspirv.hpp>
#include <thread>
#include <vector>

#include "engine/compile_ahead.h"
#include "engine/kernels/specialised_kernels.h"
#include "engine/residency/tape_windows.h"
#include "gpu/commands.h"
#include "gpu/gpu_environment.h"
#include "shaders/specialise.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::KernelKind;

const std::string kSpheres = R"({"name": "a", "sphere": {"radius": 1, "range": 0.5}},
  {"name": "b", "sphere": {"center": [1.2, 0, 0], "radius": 0.8, "range": 0.5}}, )";
const std::string kBlend = kSpheres + R"({"gradient": {"children": ["a", "b"], "opening": {"preset": "CAMEL"}}})";

KernelKind kind_of(const std::string& nodes) {
  return KernelKind::of(resident(test_support::scene_of_nodes(nodes))->tape());
}

TEST(KernelCache, SpecialisedKernelsAreValidAndSmaller) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  const KernelKind kind = kind_of(kBlend);
  for (const shaders::Spirv& shader : {shaders::kPointsGradient, shaders::kMeshSample, shaders::kGridValue}) {
    const auto kernel = shaders::specialise(shader, kind.constants());
    ASSERT_TRUE(kernel.ok()) << kernel.status();
    EXPECT_TRUE(tools.Validate(*kernel));
    EXPECT_LT(2 * kernel->size(), shader.size());
  }
  const std::vector<std::uint32_t> rubbish{1, 2, 3};
  EXPECT_EQ(shaders::specialise(rubbish, {}).status().code(), absl::StatusCode::kInternal);
}

TEST(KernelCache, TheLeastRecentlyUsedKernelIsFreed) {
  engine::KernelCache kernels(device(), {.most = 2, .specialised = nullptr});
  int waits = 0;
  const auto get = [&](const shaders::Spirv& shader) {
    auto kernel = kernels.get(shader, {}, [&] { ++waits; });
    EXPECT_TRUE(kernel.ok()) << kernel.status();
    return *kernel;
  };
  const gpu::SharedPipeline share = get(shaders::kMeshShare);
  get(shaders::kMeshNear);
  EXPECT_EQ(get(shaders::kMeshShare), share);
  EXPECT_EQ(waits, 2);
  get(shaders::kMeshList);  // kMeshNear is freed
  EXPECT_EQ(kernels.counts().held, 2u);
  EXPECT_EQ(get(shaders::kMeshShare), share);
  EXPECT_EQ(waits, 3);
  get(shaders::kMeshNear);
  EXPECT_EQ(waits, 4);
  EXPECT_EQ(kernels.counts().compiled, 4u);
  EXPECT_EQ(kernels.counts().held, 2u);
}

TEST(KernelCache, AFreedKernelLivesOnInTheCommandsThatUseIt) {
  auto commands = gpu::Commands::begin(device());
  ASSERT_TRUE(commands.ok());
  const auto buffer = gpu::Buffer::create(device(), 256, gpu::Buffer::Use::kDevice);
  ASSERT_TRUE(buffer.ok());
  std::weak_ptr<const gpu::Pipeline> watched;
  {
    engine::KernelCache kernels(device(), {.most = 1, .specialised = nullptr});
    const auto kernel = kernels.get(shaders::kMeshShare);
    ASSERT_TRUE(kernel.ok());
    watched = *kernel;
    ASSERT_TRUE(commands->dispatch_nothing(*kernel, *buffer).ok());
  }
  EXPECT_FALSE(watched.expired());
  EXPECT_TRUE(commands->submit().ok());
  EXPECT_TRUE(commands->wait().ok());
  commands = absl::CancelledError();  // destroyed
  EXPECT_TRUE(watched.expired());
}

TEST(KernelCache, OneKernelThatSeveralThreadsWantIsCompiledOnce) {
  engine::KernelCache kernels(device());
  constexpr int kThreads = 4;
  std::array<gpu::SharedPipeline, kThreads> got;
  std::barrier start(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      start.arrive_and_wait();
      auto kernel = kernels.get(shaders::kMeshShare);
      EXPECT_TRUE(kernel.ok()) << kernel.status();
      if (kernel.ok()) got[t] = *std::move(kernel);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(got[0]);
  for (const gpu::SharedPipeline& kernel : got) EXPECT_EQ(kernel, got[0]);
  EXPECT_EQ(kernels.counts().compiled, 1u);
  EXPECT_EQ(kernels.counts().held, 1u);
}

// Kernels that are compiled at the same time cannot be freed, so that they can be more than the most for a while.
TEST(KernelCache, IsBackAtTheMostAfterManyAtOnce) {
  engine::KernelCache kernels(device(), {.most = 1, .specialised = nullptr});
  const std::array<const shaders::Spirv*, 3> wanted = {&shaders::kMeshShare, &shaders::kMeshNear, &shaders::kMeshList};
  std::barrier start(std::ssize(wanted));
  std::vector<std::thread> threads;
  for (const shaders::Spirv* const shader : wanted) {
    threads.emplace_back([&, shader] {
      start.arrive_and_wait();
      EXPECT_TRUE(kernels.get(*shader).ok());
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(kernels.get(shaders::kMeshConnect).ok());
  EXPECT_EQ(kernels.counts().held, 1u);
}

TEST(KernelCache, ScenesOfTheSameKindsShareAKernelAndOthersDoNot) {
  const KernelKind kind = kind_of(kBlend);
  const std::string moved = R"({"name": "a", "sphere": {"center": [0, 3, 0], "radius": 2, "range": 1}},
    {"name": "b", "sphere": {"radius": 0.8, "range": 0.5}},
    {"gradient": {"children": ["a", "b"], "opening": {"preset": "ORGANIC"}}})";
  EXPECT_EQ(kind_of(moved).constants(), kind.constants());
  EXPECT_NE(kind_of(kSpheres + R"({"ricci": {"children": ["a", "b"], "exponent": 2}})").constants(), kind.constants());
  EXPECT_NE(kind_of(kSpheres + R"({"box": {"half_size": [1, 1, 1], "range": 0.5}},
    {"gradient": {"children": ["a", "b", "#2"], "opening": {"preset": "CAMEL"}}})")
                .constants(),
            kind.constants());
  EXPECT_NE(KernelKind::single_leaf(resident(test_support::scene_of_nodes(kBlend))->tape()).constants(),
            kind.constants());
}

TEST(CompileAhead, MakesTheKernelsOfTheNextEdit) {
  const auto specialised = std::make_shared<engine::SpecialisedKernels>();
  engine::CompileAhead ahead({}, {}, specialised);
  const auto scene = std::make_shared<const v1::Scene>(test_support::scene_of_nodes(kBlend));
  const auto no_operators = std::make_shared<const blobtree::OperatorTable>();
  ahead.edited(scene, no_operators, resident(*scene));
  ahead.wait();
  EXPECT_EQ(ahead.mixes(), 3u);  // another blend does not change the mix
  // The same mix of kinds makes no further work.
  ahead.edited(scene, no_operators, resident(*scene));
  ahead.wait();
  EXPECT_EQ(ahead.mixes(), 3u);
  // The kernels that a modeller's next edit needs are already specialised.
  const std::uint64_t made = specialised->made();
  EXPECT_GT(made, 0u);
  const KernelKind boxed = kind_of(kSpheres + R"({"name": "c", "box": {"half_size": [1, 1, 1], "range": 0.5}},
    {"gradient": {"children": ["a", "b", "c"], "opening": {"preset": "CAMEL"}}})");
  const KernelKind windowed = engine::TapeWindows::windowed(device(), boxed);
  ASSERT_TRUE(specialised->get(shaders::kMeshSample, windowed.constants()).ok());
  EXPECT_EQ(specialised->made(), made);
}

}  // namespace
}  // namespace isofield::gpu_test
