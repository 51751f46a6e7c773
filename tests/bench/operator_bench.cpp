// Measures what an operator costs: making it resident in either representation, and evaluating it.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "engine/residency/volume_cache.h"
#include "engine/session.h"
#include "operators/profile_table.h"
#include "support/random_scene.h"

namespace isofield {
namespace {

using operators::Silhouette;

struct Devices {
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<engine::KernelCache> kernels;
  std::unique_ptr<engine::VolumeCache> volumes;
};

Devices& devices() {
  static Devices all = [] {
    Devices d;
    d.device = gpu::Device::create({}).value();
    d.kernels = std::make_unique<engine::KernelCache>(*d.device);
    d.volumes = std::make_unique<engine::VolumeCache>(*d.device, *d.kernels);
    return d;
  }();
  return all;
}

operators::Operator gradient(int size, const Silhouette& silhouette) {
  return operators::Gradient{.silhouette = silhouette, .volume = size};
}

// Makes a volume with partials resident, from the operator's parameters.
void build_volume(benchmark::State& state, int size, const Silhouette& silhouette) {
  for (auto _ : state) benchmark::DoNotOptimize(devices().volumes->get(gradient(size, silhouette)).value());
  state.counters["nodes/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * size * size * size, benchmark::Counter::kIsRate);
}

void build_profile(benchmark::State& state, const Silhouette& silhouette, const operators::Opening& opening) {
  for (auto _ : state) {
    auto session = engine::Session::begin(*devices().device).value();
    const operators::ProfileTable profile = operators::silhouette_table(silhouette);
    const operators::ProfileTable angles = operators::opening_table(opening);
    const gpu::Buffer profile_buffer = session.upload(std::span(profile)).value();
    const gpu::Buffer angle_buffer = session.upload(std::span(angles)).value();
    if (!session.run().ok()) return state.SkipWithError("no upload");
  }
}

// Evaluates values and first and second partials at random fields: of a volume of `size`, or of the smooth profile if
// `size` is 0. With `is_first` the profile yields no second partials.
void evaluate(benchmark::State& state, int size, bool is_first = false) {
  Devices& d = devices();
  test_support::Random random(2);
  constexpr std::uint32_t kCount = 1 << 20;
  std::vector<std::array<float, 4>> arguments(kCount);
  for (auto& a : arguments) {
    for (int i = 0; i < 3; ++i) a[i] = static_cast<float>(random.number(0, 1));
  }
  auto session = engine::Session::begin(*d.device).value();
  const gpu::Buffer argument_buffer = session.upload(std::span(arguments)).value();
  if (!session.run().ok()) return state.SkipWithError("no upload");
  const auto results = gpu::Buffer::create(*d.device, std::size_t{48} * kCount, gpu::Buffer::Use::kDevice).value();
  const engine::VolumeLease volume = size > 0 ? d.volumes->get(gradient(size, {})).value() : nullptr;
  const shaders::Spirv& shader = volume     ? shaders::kOperatorVolumeProbe
                                 : is_first ? shaders::kOperatorFirstProbe
                                            : shaders::kOperatorBlendProbe;
  const gpu::SharedPipeline kernel = d.kernels->get(shader, {.volume_set = 1}).value();
  gpu::Commands::Bindings bindings{{4, &argument_buffer}, {5, &results}};
  if (volume) bindings.emplace_back(12, &volume->buffer());
  const std::array<std::uint32_t, 4> constants{kCount, 0, static_cast<std::uint32_t>(size), 0};
  for (auto _ : state) {
    auto work = gpu::Commands::begin(*d.device).value();
    if (!work.dispatch(kernel, bindings, constants, kCount / 64).ok() || !work.submit().ok() || !work.wait().ok()) {
      return state.SkipWithError("no dispatch");
    }
  }
  state.counters["look-ups/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kCount, benchmark::Counter::kIsRate);
}

template <class Function>
void add(const std::string& name, Function f) {
  benchmark::RegisterBenchmark(name.c_str(), f)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->MinWarmUpTime(0.01);
}

[[maybe_unused]] const bool is_registered = [] {
  const Silhouette bulge{Silhouette::Kind::kBulge, 0.8};
  for (const int size : {16, 32, 64, 128}) {
    const std::string cube = std::to_string(size) + "^3";
    add("operator/volume/build " + cube + " smooth", [size](benchmark::State& s) { build_volume(s, size, {}); });
    add("operator/volume/build " + cube + " bulge",
        [size, bulge](benchmark::State& s) { build_volume(s, size, bulge); });
    add("operator/volume/look up " + cube, [size](benchmark::State& s) { evaluate(s, size); });
  }
  add("operator/profile/build smooth camel", [](benchmark::State& s) { build_profile(s, {}, operators::camel()); });
  add("operator/profile/build bulge contact",
      [bulge](benchmark::State& s) { build_profile(s, bulge, operators::contact()); });
  add("operator/profile/evaluate smooth", [](benchmark::State& s) { evaluate(s, 0); });
  add("operator/profile/evaluate smooth, first partials", [](benchmark::State& s) { evaluate(s, 0, true); });
  add("operator/profile/silhouette table of a bulge", [bulge](benchmark::State& s) {
    for (auto _ : s) benchmark::DoNotOptimize(operators::silhouette_table(bulge));
  });
  add("operator/profile/opening table", [](benchmark::State& s) {
    for (auto _ : s) benchmark::DoNotOptimize(operators::opening_table(operators::contact()));
  });
  return true;
}();

}  // namespace
}  // namespace isofield
