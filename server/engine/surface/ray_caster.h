// Where rays meet the surface of a scene.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/points/field_evaluator.h"
#include "engine/surface/surface_index.h"

namespace isofield::engine {

struct RayRequest {
  // 3 numbers a ray, of magnitude at most kMaxCoordinate; directions of any length but 0.
  std::span<const float> origins, directions;
  double max_distance = std::numeric_limits<double>::infinity();  // > 0
  SurfaceRequest surface;
};

// A number, or 3, a ray.
struct RayHits {
  static constexpr std::uint32_t kNoNode = ~0u;

  std::vector<float> distances;      // along the ray, model units, >= 0; infinite where nothing is hit
  std::vector<float> positions;      // 0, 0, 0 where nothing is hit
  std::vector<float> normals;        // unit length, outward; 0, 0, 0 where nothing is hit
  std::vector<std::uint32_t> nodes;  // in Scene::nodes: the primitive that is hit; kNoNode where nothing is
  std::vector<std::uint8_t> inside;  // 1: the ray starts inside, so that the hit is where it comes out
  double cell_size = 0;
};

// A stretch of a ray that is inside, or outside, for a cell's length at least is not missed, and a hit lies within
// kRayTolerance of a cell of where float32 evaluation has it.
inline constexpr double kRayTolerance = 1e-4;

// The host walks each ray through the bricks that the surface may cross; the device evaluates the field in there, for
// all rays of a batch at once: a few bricks further in each round, and for those that have crossed the surface closer
// to it. Thread-safe.
class RayCaster {
 public:
  explicit RayCaster(FieldEvaluator& fields) : fields_(fields) {}

  // With stated bounds a ray that comes from outside starts where it enters them.
  // RESOURCE_EXHAUSTED: as SurfaceIndexCache::get().
  absl::StatusOr<RayHits> cast(const SceneLease& scene, const RayRequest& request,
                               const FieldEvaluator::Cancelled& cancelled = {});

 private:
  FieldEvaluator& fields_;
  SurfaceIndexCache indices_;
};

}  // namespace isofield::engine
