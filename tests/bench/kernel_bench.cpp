// The time to mesh the first scene of a mix of kinds, with kernels compiled from nothing, and with those that an
// earlier process or CompileAhead has left behind. Each iteration has an engine of its own, like a process that has
// just begun.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "engine/compile_ahead.h"
#include "engine/engine.h"
#include "support/scene_text.h"

namespace isofield {
namespace {

const std::string kSpheres = R"({"name": "a", "sphere": {"radius": 1, "range": 0.5}},
  {"name": "b", "sphere": {"center": [1.2, 0, 0], "radius": 0.8, "range": 0.5}}, )";

v1::Scene blend() {
  return test_support::scene_of_nodes(kSpheres +
                                      R"({"gradient": {"children": ["a", "b"], "opening": {"preset": "CAMEL"}}})");
}

v1::Scene blend_with_box() {
  return test_support::scene_of_nodes(kSpheres + R"({"name": "c", "box": {"half_size": [0.3, 0.3, 0.3], "range": 0.3}},
    {"gradient": {"children": ["a", "b", "c"], "opening": {"preset": "CAMEL"}}})");
}

// The folder in which the driver keeps what it compiles. It reads the variable when a device is created.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / "isofield_kernel_bench") {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    setenv("MESA_SHADER_CACHE_DIR", path_.c_str(), 1);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string kernels() const { return path_ / "kernels"; }

 private:
  const std::filesystem::path path_;
};

double seconds_to_mesh(const v1::Scene& scene, const std::shared_ptr<engine::SpecialisedKernels>& specialised) {
  const auto engine =
      engine::Engine::create({}, {}, {}, {.is_on = false, .folder = {}}, {.specialised = specialised}).value();
  const engine::SceneLease lease = engine->make_resident(scene).value();
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(engine->mesher().mesh(*lease, {.cell_size = 0.05}, {}).value());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void NewMix_FromNothing(benchmark::State& state) {
  for (auto _ : state) {
    const Folder folder;
    state.SetIterationTime(seconds_to_mesh(blend_with_box(), std::make_shared<engine::SpecialisedKernels>()));
  }
}

void NewMix_OfAnEarlierProcess(benchmark::State& state) {
  const Folder folder;
  seconds_to_mesh(blend_with_box(), std::make_shared<engine::SpecialisedKernels>(folder.kernels()));
  for (auto _ : state) {
    state.SetIterationTime(
        seconds_to_mesh(blend_with_box(), std::make_shared<engine::SpecialisedKernels>(folder.kernels())));
  }
}

void NewMix_CompiledAhead(benchmark::State& state) {
  for (auto _ : state) {
    const Folder folder;
    const auto specialised = std::make_shared<engine::SpecialisedKernels>();
    const auto engine =
        engine::Engine::create({}, {}, {}, {.is_on = false, .folder = {}}, {.specialised = specialised}).value();
    const auto edited = std::make_shared<const v1::Scene>(blend());
    engine::CompileAhead ahead({}, {}, specialised);
    ahead.edited(edited, std::make_shared<const blobtree::OperatorTable>(), engine->make_resident(*edited).value());
    ahead.wait();
    state.SetIterationTime(seconds_to_mesh(blend_with_box(), specialised));
  }
}

BENCHMARK(NewMix_FromNothing)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(NewMix_OfAnEarlierProcess)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(NewMix_CompiledAhead)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace
}  // namespace isofield
