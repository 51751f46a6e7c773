// Measures what the engine does in a second, in process. tests/bench/run prints it as a table with ratios.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>

#include "blobtree/primitives/falloff.h"
#include "engine/engine.h"
#include "engine/mesh/mesh_tracker.h"
#include "isofield/import.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/shared_files.h"

namespace isofield {
namespace {

using engine::ResultLayout;

std::unique_ptr<engine::Engine> make_engine(const engine::TierTwoOptions& tier_two) {
  auto created = engine::Engine::create({}, {}, {}, tier_two);
  if (!created.ok()) {
    std::cerr << created.status() << "\n";
    std::exit(1);
  }
  return *std::move(created);
}

engine::Engine& the_engine() {
  static const auto engine = make_engine({.hot_points = 0});
  return *engine;
}

// This engine does without tier two.
engine::Engine& interpreting_engine() {
  static const auto engine = make_engine({.is_on = false});
  return *engine;
}

engine::SceneLease resident(const v1::Scene& scene, engine::Engine& engine = the_engine()) {
  auto lease = engine.make_resident(scene);
  if (!lease.ok()) {
    std::cerr << lease.status() << "\n";
    std::exit(1);
  }
  return *std::move(lease);
}

enum class Join { kSum, kMax, kCamel };

void join_all(v1::Scene& scene, Join join) {
  const int count = scene.nodes_size();
  v1::Node& root = *scene.add_nodes();
  for (int i = 0; i < count; ++i) {
    const std::string child = test_support::place(i);
    switch (join) {
      case Join::kSum:
        root.mutable_sum()->add_children(child);
        break;
      case Join::kMax:
        root.mutable_max()->add_children(child);
        break;
      case Join::kCamel:
        root.mutable_gradient()->add_children(child);
        break;
    }
  }
}

// Makes raw soft spheres of radius R in the cube [-1, 1]^3. Each overlaps a few others, whatever their number is.
v1::Scene soft_spheres(int count, Join join, double reach = 1) {
  test_support::Random random(42);
  v1::Scene scene;
  const double r = 0.9 * std::cbrt(8.0 / count) * reach;
  for (int i = 0; i < count; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-reach, reach));
    s->set_radius(blobtree::kR0 * r);
    s->set_range((1 - blobtree::kR0) * r);
  }
  join_all(scene, join);
  return scene;
}

v1::Scene neuron(ImportOperator op) {
  const auto path = test_support::shared_file("data/hemibrain_1734350788.swc");
  ImportOptions options;
  options.op = op;
  auto imported = import_file(path.string(), options);
  if (!imported.ok()) {
    std::cerr << imported.status() << "\n";
    std::exit(1);
  }
  return imported->scene;
}

void mesh(benchmark::State& state, const v1::Scene& scene, double cell) {
  const engine::SceneLease lease = resident(scene);
  static std::size_t seen = 1u << 16;
  std::size_t vertices = 0, cells = 0;
  (void)the_engine().mesher().mesh(*lease, {.cell_size = cell}, {});  // kernels compile when they first run
  for (auto _ : state) {
    // A mesh that was made is kept, so the requests differ by a number that does not change the mesh.
    const auto m = the_engine().mesher().mesh(*lease, {.cell_size = cell, .bricks_at_once = ++seen}, {});
    if (!m.ok()) return state.SkipWithError(std::string(m.status().message()).c_str());
    vertices = m->positions.size() / 3;
    cells = m->cells;
  }
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["primitives"] = static_cast<double>(lease->tape().leaves.size());
}

void mesh_again(benchmark::State& state, const v1::Scene& scene, double cell) {
  const engine::SceneLease lease = resident(scene);
  (void)the_engine().mesher().mesh(*lease, {.cell_size = cell}, {});
  for (auto _ : state) {
    const auto m = the_engine().mesher().mesh(*lease, {.cell_size = cell}, {});
    if (!m.ok()) return state.SkipWithError(std::string(m.status().message()).c_str());
  }
}

// Moves a primitive to and fro by a cell and follows its mesh: from the edited scene to the bricks that changed.
void track(benchmark::State& state, v1::Scene scene, double cell) {
  engine::SceneLease lease = resident(scene);
  engine::MeshTracker tracker(the_engine().mesher(), {.cell_size = cell});
  if (!tracker.update(lease, {}).ok()) return state.SkipWithError("no mesh");
  auto* sphere = scene.mutable_nodes(0)->mutable_sphere();
  double step = cell;
  std::size_t bricks = 0;
  for (auto _ : state) {
    sphere->set_center(0, sphere->center(0) + step);
    step = -step;
    auto edited = the_engine().edit(*lease, scene, {0}, {});
    if (!edited.ok()) return state.SkipWithError("no edit");
    lease = *std::move(edited);
    const auto update = tracker.update(lease, {});
    if (!update.ok() || update->is_whole) return state.SkipWithError("no local update");
    bricks = 0;
    for (const auto& cells : update->changed) bricks += cells.bricks.size();
  }
  state.counters["bricks"] = static_cast<double>(bricks);
}

std::vector<float> random_points(std::size_t count) {
  test_support::Random random(1);
  std::vector<float> xyz(3 * count);
  for (float& x : xyz) x = static_cast<float>(random.number(-1, 1));
  return xyz;
}

void count_points(benchmark::State& state, std::size_t count) {
  state.counters["points/s"] = benchmark::Counter(
      static_cast<double>(count * static_cast<std::size_t>(state.iterations())), benchmark::Counter::kIsRate);
}

void points(benchmark::State& state, const v1::Scene& scene, ResultLayout layout, std::size_t count = 1 << 20,
            engine::Engine& engine = the_engine()) {
  const engine::SceneLease lease = resident(scene, engine);
  const std::vector<float> xyz = random_points(count);
  std::vector<float> out(xyz.size() / 3 * layout.numbers());
  // A kernel of its own, if it gets one, is compiled before the clock runs.
  (void)engine.fields().evaluate(*lease, xyz, layout, out);
  engine.written_kernels().wait();
  for (auto _ : state) {
    const absl::Status s = engine.fields().evaluate(*lease, xyz, layout, out);
    if (!s.ok()) return state.SkipWithError(std::string(s.message()).c_str());
  }
  count_points(state, count);
}

// Measures the same kernel alone, with value and gradient. Points and results stay on the device.
void bare_kernel(benchmark::State& state, const v1::Scene& scene) {
  constexpr std::size_t kCount = 1 << 20;
  const engine::SceneLease lease = resident(scene);
  engine::WrittenKernels& kernels = the_engine().written_kernels();
  (void)kernels.find(*lease, true, kCount);
  kernels.wait();
  const gpu::SharedPipeline kernel = kernels.find(*lease, true, 0);
  if (!kernel) return state.SkipWithError("no kernel");
  const std::vector<float> xyz = random_points(kCount);
  auto session = engine::Session::begin(the_engine().device()).value();
  const gpu::Buffer points = session.upload(std::span(xyz)).value();
  const gpu::Buffer results = session.scratch(4 * kCount * sizeof(float)).value();
  if (!session.run().ok()) return state.SkipWithError("no upload");
  constexpr std::uint32_t kLast = kCount - 1;
  for (auto _ : state) {
    auto again = engine::Session::begin(the_engine().device()).value();
    const absl::Status s =
        again.commands().dispatch(kernel, lease->bindings(points, {{6, &points}, {7, &results}}), kLast, kCount / 64);
    if (!s.ok() || !again.run().ok()) return state.SkipWithError("no run");
  }
  count_points(state, kCount);
}

template <class Function>
void add(const std::string& name, Function f) {
  benchmark::RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

void register_all() {
  if (test_support::has_shared_file("data/hemibrain_1734350788.swc")) {
    for (const int cell : {32, 16, 8}) {
      add("mesh/neuron camel/cell " + std::to_string(cell),
          [cell](benchmark::State& s) { mesh(s, neuron(ImportOperator::kCamel), cell); });
    }
    add("mesh/neuron max/cell 16", [](benchmark::State& s) { mesh(s, neuron(ImportOperator::kMax), 16); });
  }
  for (const int count : {8, 64, 1000}) {
    const std::string spheres = std::to_string(count) + " soft spheres";
    for (const auto& [join, name] : {std::pair{Join::kSum, " sum"}, std::pair{Join::kCamel, " camel"}}) {
      add("mesh/" + spheres + name + "/128 cells",
          [count, join = join](benchmark::State& s) { mesh(s, soft_spheres(count, join), 3.0 / 128); });
      add("points/" + spheres + name + "/value and gradient", [count, join = join](benchmark::State& s) {
        points(s, soft_spheres(count, join), ResultLayout::kValueAndGradient);
      });
      if (count > 64) continue;
      add("points/" + spheres + name + "/value and gradient, interpreted", [count, join = join](benchmark::State& s) {
        points(s, soft_spheres(count, join), ResultLayout::kValueAndGradient, 1 << 20, interpreting_engine());
      });
      if (count > 8) continue;
      add("points/" + spheres + name + "/value and gradient, bare kernel",
          [count, join = join](benchmark::State& s) { bare_kernel(s, soft_spheres(count, join)); });
    }
    add("points/" + spheres + " sum/value and gradient, 64 points", [count](benchmark::State& s) {
      points(s, soft_spheres(count, Join::kSum), ResultLayout::kValueAndGradient, 64);
    });
    add("track/" + spheres + " sum/one moved by a cell/128 cells",
        [count](benchmark::State& s) { track(s, soft_spheres(count, Join::kSum), 3.0 / 128); });
    add("mesh/" + spheres + " sum/128 cells/seen before",
        [count](benchmark::State& s) { mesh_again(s, soft_spheres(count, Join::kSum), 3.0 / 128); });
    add("points/" + spheres + " sum/value",
        [count](benchmark::State& s) { points(s, soft_spheres(count, Join::kSum), ResultLayout::kValue); });
  }
}

}  // namespace
}  // namespace isofield

int main(int argc, char** argv) {
  isofield::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
