// Tests that kernels are specialised before the driver sees them, kept while they are used, and compiled ahead of
// edits.
#include "engine/kernels/kernel_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <spirv-tools/libspirv.hpp>
#include <vector>

#include "engine/compile_ahead.h"
#include "engine/kernels/specialised_kernels.h"
#include "engine/kernels/spirv_store.h"
#include "engine/residency/tape_windows.h"
#include "gpu/commands.h"
#include "gpu/gpu_environment.h"
#include "shaders/specialise.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"

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

TEST(SpirvStore, KeepsWhatWasUsedLast) {
  const test_support::TemporaryFolder folder;
  const std::vector<std::uint32_t> kernel(1000);
  const auto is_there = [&](const engine::SpirvStore& store, const char* text) { return store.load(text).has_value(); };
  const auto age = [&](int hours) {  // makes all present files older
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
      std::filesystem::last_write_time(file, file.last_write_time() - std::chrono::hours(hours));
    }
  };
  {
    const engine::SpirvStore store(folder.path(), 1 << 20);
    store.save("first", kernel);
    age(1);
    store.save("second", kernel);
    age(1);
    store.save("third", kernel);
    age(1);
    EXPECT_TRUE(is_there(store, "first"));  // and so it is used last
  }
  const engine::SpirvStore small(folder.path(), 9000);  // holds two kernels
  EXPECT_TRUE(is_there(small, "first"));
  EXPECT_FALSE(is_there(small, "second"));
  EXPECT_TRUE(is_there(small, "third"));
  small.save("fourth", kernel);  // more than a sixteenth of the limit, so one old file goes at once
  EXPECT_TRUE(is_there(small, "fourth"));
  EXPECT_EQ(is_there(small, "first") + is_there(small, "third"), 1);
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
