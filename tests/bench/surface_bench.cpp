// Measures what questions about a surface cost: rays from all around, and projections of points near it.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "blobtree/primitives/falloff.h"
#include "engine/engine.h"
#include "engine/mesh/cell_size.h"
#include "isofield/import.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/shared_files.h"

namespace isofield {
namespace {

using blobtree::dvec3;

engine::Engine& the_engine() {
  static const std::unique_ptr<engine::Engine> engine = engine::Engine::create({}, {}).value();
  return *engine;
}

// Returns raw soft spheres in the cube [-1, 1]^3, each overlapping a few others, as in bench.cpp.
v1::Scene soft_spheres(int count) {
  test_support::Random random(42);
  v1::Scene scene;
  v1::Node sum;
  const double r = 0.9 * std::cbrt(8.0 / count);
  for (int i = 0; i < count; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-1, 1));
    s->set_radius(blobtree::kR0 * r);
    s->set_range((1 - blobtree::kR0) * r);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = sum;
  return scene;
}

v1::Scene neuron() {
  ImportOptions options;
  options.op = ImportOperator::kCamel;
  return import_file(test_support::shared_file("data/hemibrain_1734350788.swc").string(), options).value().scene;
}

void add_vec(std::vector<float>& rows, const dvec3& v) {
  rows.insert(rows.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

struct Rays {
  std::vector<float> origins, directions;
};

// Returns the parallel rays of a picture, through a lattice over the scene's longest extent.
Rays picture(const blobtree::Box& box, int side) {
  Rays rays;
  const dvec3 centre = (box.min + box.max) * 0.5, size = box.max - box.min;
  const double reach = std::max({size.x, size.y, size.z});
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = (i + 0.5) / side - 0.5, y = (j + 0.5) / side - 0.5;
      add_vec(rays.origins, centre + dvec3{x, y, 1.0} * reach);
      add_vec(rays.directions, {0, 0, -1});
    }
  }
  return rays;
}

// Returns rays between random points of the scene's box. No two are alike.
Rays scattered(const blobtree::Box& box, int count) {
  test_support::Random random(3);
  const dvec3 size = box.max - box.min;
  const auto point = [&] {
    const dvec3 p = random.point(0, 1);
    return box.min + dvec3{p.x * size.x, p.y * size.y, p.z * size.z};
  };
  Rays rays;
  for (int i = 0; i < count; ++i) {
    const dvec3 from = point(), to = point();
    add_vec(rays.origins, from);
    add_vec(rays.directions, to - from);
  }
  return rays;
}

template <class Make>
void cast(benchmark::State& state, const v1::Scene& scene, std::optional<double> cell, const Make& make) {
  const engine::SceneLease lease = the_engine().make_resident(scene).value();
  const Rays rays = make(lease->tape().support);
  const engine::RayRequest request{
      .origins = rays.origins, .directions = rays.directions, .surface = {.cell_size = cell}};
  std::size_t hit = 0;
  for (auto _ : state) {
    const auto hits = the_engine().rays().cast(lease, request);
    if (!hits.ok()) return state.SkipWithError(std::string(hits.status().message()).c_str());
    hit = 0;
    for (const float t : hits->distances) hit += std::isfinite(t);
  }
  const auto count = static_cast<double>(rays.origins.size() / 3);
  state.counters["rays/s"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["hit"] = static_cast<double>(hit) / count;
}

// Measures the search for the surface, which the first rays of a scene wait for.
void find_surface(benchmark::State& state, const v1::Scene& scene, std::optional<double> cell_size) {
  const engine::SceneLease lease = the_engine().make_resident(scene).value();
  std::size_t bricks = 0;
  for (auto _ : state) {
    engine::SurfaceIndexCache cache;
    const auto index = cache.get(lease, {.cell_size = cell_size}, {}).value();
    bricks = index->tree.brick_count();
  }
  state.counters["bricks"] = static_cast<double>(bricks);
}

// Projects vertices of a mesh that were moved by up to two cells.
void project(benchmark::State& state, const v1::Scene& scene, std::optional<double> cell_size) {
  const engine::SceneLease lease = the_engine().make_resident(scene).value();
  const double cell = cell_size ? *cell_size : engine::automatic_cell_size(lease->tape(), {}).value();
  std::vector<float> points = the_engine().mesher().mesh(*lease, {.cell_size = cell}, {}).value().positions;
  points.resize(std::min<std::size_t>(points.size(), 3 * 100'000));
  test_support::Random random(7);
  for (float& x : points) x += static_cast<float>(cell * random.number(-2, 2));
  const engine::ProjectionRequest request{.points = points, .tolerance = 1e-3 * cell};
  double converged = 0;
  for (auto _ : state) {
    const auto found = the_engine().projector().project(*lease, request);
    if (!found.ok()) return state.SkipWithError(std::string(found.status().message()).c_str());
    converged = 0;
    for (const std::uint8_t c : found->converged) converged += c;
  }
  const auto count = static_cast<double>(points.size() / 3);
  state.counters["points/s"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["converged"] = converged / count;
}

template <class Function>
void add(const std::string& name, Function f) {
  benchmark::RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond)->UseRealTime()->MinWarmUpTime(0.01);
}

// `cell` is stated for scenes whose automatic cell is as small as the server admits, so that a row does not depend on
// that limit.
template <class Scene>
void add_scene(const std::string& name, const Scene& scene, std::optional<double> cell = std::nullopt) {
  add("rays/" + name + "/picture of 256 x 256", [scene, cell](benchmark::State& s) {
    cast(s, scene(), cell, [](const blobtree::Box& box) { return picture(box, 256); });
  });
  add("rays/" + name + "/65,536 scattered", [scene, cell](benchmark::State& s) {
    cast(s, scene(), cell, [](const blobtree::Box& box) { return scattered(box, 1 << 16); });
  });
  add("rays/" + name + "/finding the surface", [scene, cell](benchmark::State& s) { find_surface(s, scene(), cell); });
  add("projections/" + name, [scene, cell](benchmark::State& s) { project(s, scene(), cell); });
}

[[maybe_unused]] const bool is_registered = [] {
  for (const int count : {64, 1000}) {
    add_scene(std::to_string(count) + " soft spheres sum", [count] { return soft_spheres(count); });
  }
  if (test_support::has_shared_file("data/hemibrain_1734350788.swc")) add_scene("neuron camel", neuron, 12.5);
  return true;
}();

}  // namespace
}  // namespace isofield
