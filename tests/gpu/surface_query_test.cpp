// Compares rays and projections on the device with the reference and with formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "engine/surface/ray_caster.h"
#include "engine/surface/surface_projector.h"
#include "gpu/gpu_environment.h"
#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using engine::Projections;
using engine::RayHits;

engine::FieldEvaluator& fields() {
  static engine::FieldEvaluator evaluator(device(), kernels(), workers());
  return evaluator;
}

struct Rays {
  std::vector<float> origins, directions;

  void add(const dvec3& origin, const dvec3& direction) {
    for (const double x : {origin.x, origin.y, origin.z}) origins.push_back(static_cast<float>(x));
    for (const double x : {direction.x, direction.y, direction.z}) directions.push_back(static_cast<float>(x));
  }
  std::size_t size() const { return origins.size() / 3; }
  // Returns the ray as the caster has it.
  blobtree::Ray at(std::size_t i) const {
    const dvec3 o{origins[3 * i], origins[3 * i + 1], origins[3 * i + 2]};
    const dvec3 d{directions[3 * i], directions[3 * i + 1], directions[3 * i + 2]};
    return {o, d * (1 / length(d))};
  }
};

RayHits cast(const engine::SceneLease& scene, const Rays& rays, const engine::SurfaceRequest& surface = {},
             double max_distance = std::numeric_limits<double>::infinity()) {
  static engine::RayCaster caster(fields());
  const auto hits = caster.cast(scene, {rays.origins, rays.directions, max_distance, surface});
  EXPECT_TRUE(hits.ok()) << hits.status();
  return hits.ok() ? *hits : RayHits{};
}

dvec3 row(const std::vector<float>& rows, std::size_t i) {
  return {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
}

v1::Scene ball_scene() {
  return test_support::scene_of_nodes(
      R"([{"name": "ball", "sphere": {"center": [0.1, 0.2, -0.3], "radius": 1, "range": 0.5}}])");
}

Rays random_rays(std::uint64_t seed, int count, double reach) {
  test_support::Random random(seed);
  Rays rays;
  while (rays.size() < static_cast<std::size_t>(count)) {
    const dvec3 from = random.point(-reach, reach), to = random.point(-1.2, 1.2);
    rays.add(from, to - from);
  }
  return rays;
}

TEST(RayCaster, HitsASphereWhereTheFormulaDoes) {
  const dvec3 centre{static_cast<float>(0.1), static_cast<float>(0.2), static_cast<float>(-0.3)};
  const Rays rays = random_rays(1, 5000, 3);
  const RayHits hits = cast(resident(ball_scene()), rays);
  int hit = 0;
  double worst = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const blobtree::Ray ray = rays.at(i);
    const dvec3 o = ray.origin - centre;
    const double b = dot(o, ray.direction), c = dot(o, o) - 1, root2 = b * b - c;
    EXPECT_EQ(hits.inside[i], c < 0);
    // Rays that graze the sphere for less than a cell may miss it.
    if (root2 > 0 && root2 < hits.cell_size * hits.cell_size) continue;
    const double t = c < 0 ? -b + std::sqrt(root2) : -b - std::sqrt(root2);
    if (!(root2 > 0) || t < 0) {
      ASSERT_TRUE(std::isinf(hits.distances[i])) << i;
      EXPECT_EQ(hits.nodes[i], RayHits::kNoNode);
      continue;
    }
    ++hit;
    // The bound allows for the field's error of 2e-5 along a ray that is not perpendicular.
    worst = std::max(worst, std::abs(hits.distances[i] - t));
    ASSERT_NEAR(hits.distances[i], t, 5e-5) << i;
    const dvec3 p = row(hits.positions, i);
    EXPECT_NEAR(length(p - centre), 1, 1e-5);
    EXPECT_LE(length(row(hits.normals, i) - (p - centre)), 2e-3);
    EXPECT_EQ(hits.nodes[i], 0u);
  }
  std::cout << hit << " hits, distances within " << worst << "\n";
  EXPECT_GT(hit, 1000);
}

TEST(RayCaster, HitsBoxesAndToriWhereTheFormulasDo) {
  const engine::SceneLease box =
      resident(test_support::scene_of_nodes(R"([{"box": {"half_size": [1, 0.5, 0.25], "range": 0.25}}])"));
  Rays rays;
  rays.add({-3, 0.1, 0.1}, {2, 0, 0});
  rays.add({0.3, 0.2, 9}, {0, 0, -1e-6});
  rays.add({0, 0, 0}, {0, 3e8, 0});      // from inside
  rays.add({-3, 0.5, 0.1}, {1, 0, 0});   // along a face
  rays.add({-3, 0.75, 0.1}, {1, 0, 0});  // beside it
  rays.add({3, 0, 0}, {1, 0, 0});        // away from it
  RayHits hits = cast(box, rays);
  EXPECT_NEAR(hits.distances[0], 2, 1e-5);
  EXPECT_NEAR(hits.distances[1], 8.75, 1e-5);
  EXPECT_NEAR(hits.distances[2], 0.5, 1e-5);
  EXPECT_EQ(hits.inside[2], 1);
  EXPECT_LE(length(row(hits.normals, 0) - dvec3{-1, 0, 0}), 1e-5);
  EXPECT_LE(length(row(hits.normals, 1) - dvec3{0, 0, 1}), 1e-5);
  EXPECT_LE(length(row(hits.normals, 2) - dvec3{0, 1, 0}), 1e-5);
  // The field is 0.5 along the face, so rounding decides, but a hit must be on the face.
  if (std::isfinite(hits.distances[3])) {
    EXPECT_NEAR(hits.positions[10], 0.5, 1e-5);
  }
  EXPECT_TRUE(std::isinf(hits.distances[4]));
  EXPECT_TRUE(std::isinf(hits.distances[5]));

  const engine::SceneLease torus = resident(
      test_support::scene_of_nodes(R"([{"torus": {"major_radius": 1, "minor_radius": 0.25, "range": 0.25}}])"));
  Rays through;
  through.add({0, 0, 5}, {0, 0, -1});  // through the hole
  through.add({1, 0, 5}, {0, 0, -1});
  through.add({-5, 0, 0}, {1, 0, 0});
  through.add({0, 0, 0}, {0, 1, 0});  // from the hole outwards
  through.add({0, 1, 0}, {0, 1, 0});  // from within the tube
  hits = cast(torus, through);
  EXPECT_TRUE(std::isinf(hits.distances[0]));
  EXPECT_NEAR(hits.distances[1], 4.75, 1e-5);
  EXPECT_NEAR(hits.distances[2], 3.75, 1e-5);
  EXPECT_NEAR(hits.distances[3], 0.75, 1e-5);
  EXPECT_NEAR(hits.distances[4], 0.25, 1e-5);
}

// The first change of side along a ray that lasts for a cell, found by small steps of the reference.
struct Marched {
  bool begins_inside = false;
  double first_change = std::numeric_limits<double>::infinity();  // it may be of any length
  double sure_change = std::numeric_limits<double>::infinity();   // it lasts
};
Marched march(const reference::Evaluator& exact, const engine::IsoLevel& level, const blobtree::Ray& ray, double end,
              double cell) {
  const double step = cell / 16;
  Marched m;
  m.begins_inside = level.excess(exact.value(ray.origin)) > 0;
  double since = -1;
  for (double t = step; t < end; t += step) {
    if ((level.excess(exact.value(ray.point(t))) > 0) == m.begins_inside) {
      since = -1;
      continue;
    }
    if (since < 0) since = t;
    m.first_change = std::min(m.first_change, t);
    if (t - since > 1.2 * cell) {
      m.sure_change = since;
      return m;
    }
  }
  return m;
}

TEST(RayCaster, FollowsTheReferenceOnRandomScenes) {
  int hit = 0, missed = 0;
  double worst = 0;
  for (const int nodes : {2, 10, 40}) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      const v1::Scene message = test_support::random_scene(900 * nodes + seed, {.nodes = nodes});
      const engine::SceneLease scene = resident(message);
      const reference::Evaluator exact(test_support::read_or_die(message));
      const engine::IsoLevel level{scene->tape().law == operators::Law::kSigned ? 0.0 : 0.5, scene->tape().law};
      // A field that operators make more than 0 everywhere needs bounds. They are far away, so that no ray enters them.
      const blobtree::Box bounds{{-6, -6, -6}, {6, 6, 6}};
      const engine::SurfaceRequest surface{.iso = level.iso, .cell_size = 0.06, .bounds = bounds};
      const Rays rays = random_rays(seed + 5, 50, 2.5);
      const RayHits hits = cast(scene, rays, surface);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const blobtree::Ray ray = rays.at(i);
        const double end = clip(ray, bounds, {0, 100}).end;
        const Marched m = march(exact, level, ray, end, hits.cell_size);
        const std::string where =
            "nodes " + std::to_string(nodes) + ", seed " + std::to_string(seed) + ", ray " + std::to_string(i);
        // If the field is 0.5 within rounding, either side is right.
        if (std::abs(level.excess(exact.value(ray.origin))) < 1e-4) continue;
        ASSERT_EQ(hits.inside[i] != 0, m.begins_inside) << where;
        if (std::isinf(hits.distances[i])) {
          ASSERT_TRUE(std::isinf(m.sure_change)) << where << ": " << m.sure_change;
          ++missed;
          continue;
        }
        ++hit;
        const double t = hits.distances[i];
        ASSERT_LE(t, m.sure_change + hits.cell_size) << where;
        // A change that is shorter than a step of the march counts, too.
        if (std::isfinite(m.first_change)) {
          ASSERT_GE(t, m.first_change - hits.cell_size / 16 - 1e-4) << where;
        }
        // The reference changes sides there, within the tolerance and the field's own error.
        const double room = 1e-4 * hits.cell_size + 1e-5;
        const double before = level.excess(exact.value(ray.point(t - room)));
        const double after = level.excess(exact.value(ray.point(t + room)));
        const bool crosses = (before > 0) != (after > 0) || std::min(std::abs(before), std::abs(after)) < 5e-5;
        ASSERT_TRUE(crosses) << where << ": " << before << " and " << after;
        const reference::Sample s = exact.evaluate(row(hits.positions, i));
        worst = std::max(worst, std::abs(s.value - level.iso));
        EXPECT_NEAR(length(row(hits.normals, i)), 1, 1e-5) << where;
        EXPECT_NE(hits.nodes[i], RayHits::kNoNode) << where;
      }
    }
  }
  std::cout << hit << " hits, " << missed << " misses; field at hits within " << worst << " of iso\n";
  EXPECT_GT(hit, 80);
}

TEST(RayCaster, NamesThePrimitiveWhoseSurfaceIsHit) {
  const engine::SceneLease scene = resident(test_support::scene_of_nodes(R"([
    {"name": "block", "box": {"half_size": [1, 1, 1], "range": 0.3}},
    {"name": "drill", "cylinder": {"a": [0, 0, -2], "b": [0, 0, 2], "radius": 0.4, "range": 0.3}},
    {"name": "far", "sphere": {"center": [4, 0, 0], "radius": 0.5, "range": 0.3}},
    {"name": "bored", "difference": {"children": ["block", "drill"]}},
    {"max": {"children": ["bored", "far"]}}])"));
  Rays rays;
  rays.add({-3, 0.1, 0}, {1, 0, 0});
  rays.add({0, 0, 0}, {1, 0, 0});  // from the bore
  rays.add({8, 0, 0.1}, {-1, 0, 0});
  rays.add({0, 0, 5}, {0, 0, -1});  // through the bore
  const RayHits hits = cast(scene, rays);
  EXPECT_EQ(hits.nodes, (std::vector<std::uint32_t>{0, 1, 2, RayHits::kNoNode}));
  EXPECT_EQ(hits.inside, (std::vector<std::uint8_t>{0, 0, 0, 0}));
  EXPECT_LE(length(row(hits.normals, 1) - dvec3{-1, 0, 0}), 1e-4);
}

TEST(RayCaster, TakesRaysFromFarAwayAndEndsThemWhereAsked) {
  const engine::SceneLease scene = resident(ball_scene());
  Rays rays;
  rays.add({1e6, 0.2, -0.3}, {-1, 0, 0});
  rays.add({0.1, -1e9, -0.3}, {0, 1, 0});
  const RayHits hits = cast(scene, rays);
  EXPECT_NEAR(hits.positions[0], 1.1, 1e-5);
  EXPECT_NEAR(hits.positions[4], -0.8, 1e-5);
  EXPECT_FLOAT_EQ(hits.distances[0], 1e6 - 1.1);
  // Doubles along this ray are farther apart than the cells.
  const engine::SceneLease grain =
      resident(test_support::scene_of_nodes(R"([{"sphere": {"radius": 1e-6, "range": 1e-6}}])"));
  Rays to_grain;
  to_grain.add({1e9, 0, 0}, {-1, 0, 0});
  EXPECT_FLOAT_EQ(cast(grain, to_grain).distances[0], 1e9);
  Rays near;
  near.add({-2.9, 0.2, -0.3}, {1, 0, 0});  // 2 away
  EXPECT_TRUE(std::isinf(cast(scene, near, {}, 1.99).distances[0]));
  EXPECT_NEAR(cast(scene, near, {}, 2.01).distances[0], 2, 1e-5);
}

TEST(RayCaster, GivesNothingForNothing) {
  const engine::SceneLease empty = resident(test_support::scene_of_nodes(R"([
    {"name": "a", "sphere": {"radius": 0.3, "range": 0.3}},
    {"name": "b", "sphere": {"center": [5, 0, 0], "radius": 0.3, "range": 0.3}},
    {"min": {"children": ["a", "b"]}}])"));
  const RayHits hits = cast(empty, random_rays(3, 10, 2));
  for (const float t : hits.distances) EXPECT_TRUE(std::isinf(t));
  EXPECT_TRUE(cast(resident(ball_scene()), {}).distances.empty());
}

TEST(RayCaster, GivesTheSameBitsWhateverTheBatch) {
  const engine::SceneLease scene = resident(test_support::random_scene(5, {.nodes = 120, .all_operators = false}));
  const Rays rays = random_rays(9, 40'000, 3);
  const RayHits all = cast(scene, rays);
  for (const std::size_t i : {0u, 1u, 777u, 39'999u}) {
    Rays one;
    one.origins.assign(&rays.origins[3 * i], &rays.origins[3 * i] + 3);
    one.directions.assign(&rays.directions[3 * i], &rays.directions[3 * i] + 3);
    const RayHits hit = cast(scene, one);
    EXPECT_EQ(hit.distances[0], all.distances[i]);
    EXPECT_EQ(std::memcmp(hit.normals.data(), &all.normals[3 * i], 12), 0);
    EXPECT_EQ(hit.nodes[0], all.nodes[i]);
  }
}

TEST(RayCaster, StopsWhenCancelled) {
  engine::RayCaster caster(fields());
  const Rays rays = random_rays(9, 1000, 3);
  int asked = 0;
  const auto hits = caster.cast(resident(ball_scene()), {rays.origins, rays.directions}, [&] { return ++asked > 2; });
  EXPECT_EQ(hits.status().code(), absl::StatusCode::kCancelled);
}

Projections project(const engine::SceneLease& scene, const std::vector<float>& points, double iso, double tolerance) {
  engine::SurfaceProjector projector(fields());
  const auto found = projector.project(*scene, {points, iso, tolerance});
  EXPECT_TRUE(found.ok()) << found.status();
  return found.ok() ? *found : Projections{};
}

TEST(SurfaceProjector, FindsTheNearestPointOfASphere) {
  const dvec3 centre{0.1, 0.2, -0.3};
  test_support::Random random(4);
  std::vector<float> points;
  std::vector<dvec3> nearest;
  while (nearest.size() < 2000) {
    const dvec3 p = random.point(-1.5, 1.5);
    const double far = length(p - centre);
    // The points are within the reach, and not in the middle, where there is no gradient.
    if (far > 1.49 || far < 0.65) continue;
    for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
    nearest.push_back(centre + (p - centre) * (1 / far));
  }
  const Projections found = project(resident(ball_scene()), points, 0.5, 2e-5);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    ASSERT_EQ(found.converged[i], 1) << i;
    ASSERT_LE(found.residuals[i], 2e-5);
    ASSERT_LE(length(row(found.positions, i) - nearest[i]), 1e-4) << i;
    ASSERT_LE(length(row(found.normals, i) - (nearest[i] - centre)), 1e-3) << i;
  }
}

TEST(SurfaceProjector, LeavesPointsWithoutAGradientWhereTheyAre) {
  const std::vector<float> points{5, 5, 5, 0.1f, 0.2f, -0.3f};
  const Projections found = project(resident(ball_scene()), points, 0.5, 1e-5);
  EXPECT_EQ(found.positions, points);
  EXPECT_EQ(found.converged, (std::vector<std::uint8_t>{0, 0}));
  EXPECT_TRUE(std::isinf(found.residuals[0]));
  EXPECT_EQ(row(found.normals, 0), dvec3());
}

TEST(SurfaceProjector, ReachesTheSurfaceOfRandomScenes) {
  int converged = 0, reached = 0;
  for (const int nodes : {3, 20, 80}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const v1::Scene message = test_support::random_scene(700 * nodes + seed, {.nodes = nodes});
      const engine::SceneLease scene = resident(message);
      const reference::Evaluator exact(test_support::read_or_die(message));
      const double iso = scene->tape().law == operators::Law::kSigned ? 0 : 0.5;
      const engine::IsoLevel level{iso, scene->tape().law};
      test_support::Random random(seed + 3);
      // Nothing is inside in some scenes.
      bool has_surface = false;
      for (int i = 0; i < 500; ++i) has_surface |= level.excess(exact.value(random.point(-1.5, 1.5))) > 0;
      if (!has_surface) continue;
      std::vector<float> points;
      while (points.size() < 3 * 200) {
        const dvec3 p = random.point(-2, 2);
        if (length(exact.evaluate(p).gradient) < 0.05) continue;
        for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
      }
      const Projections found = project(scene, points, iso, 1e-4);
      for (std::size_t i = 0; i < 200; ++i) {
        ++reached;
        if (!found.converged[i]) continue;
        ++converged;
        const reference::Sample s = exact.evaluate(row(found.positions, i));
        // The residual is the distance to first order; the field's own error comes on top.
        ASSERT_LE(std::abs(s.value - iso), 1.1e-4 * length(s.gradient) + 1e-4) << nodes << " nodes, seed " << seed;
      }
    }
  }
  std::cout << converged << " of " << reached << " points converged\n";
  EXPECT_GT(converged, reached * 9 / 10);
  EXPECT_GT(reached, 600);
}

}  // namespace
}  // namespace isofield::gpu_test
