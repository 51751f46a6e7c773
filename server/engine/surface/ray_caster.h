// RayCaster finds the points at which rays first meet the surface of a scene.
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
  // Both have 3 numbers a ray, of magnitude at most kMaxCoordinate. Directions may have any length but 0.
  std::span<const float> origins, directions;
  double max_distance = std::numeric_limits<double>::infinity();  // > 0
  SurfaceRequest surface;
};

// Each member has one number, or 3, for each ray.
struct RayHits {
  static constexpr std::uint32_t kNoNode = ~0u;

  std::vector<float> distances;      // along the ray, model units, >= 0; infinite where nothing is hit
  std::vector<float> positions;      // 0, 0, 0 where nothing is hit
  std::vector<float> normals;        // unit length, outward; 0, 0, 0 where nothing is hit
  std::vector<std::uint32_t> nodes;  // the primitive that is hit, in Scene::nodes; kNoNode where nothing is hit
  std::vector<std::uint8_t> inside;  // 1: the ray starts inside, and the hit is the point at which it comes out
  double cell_size = 0;
};

// A stretch of a ray that is inside, or outside, over at least the length of a cell is never missed. A hit lies within
// this part of a cell of the point at which float32 evaluation has the surface.
inline constexpr double kRayTolerance = 1e-4;

// The host walks each ray through the bricks that the surface may cross, and the device evaluates the field there for
// all rays of a batch at once. In each round the rays advance by a few bricks; then rounds narrow down where they have
// crossed the surface. Thread-safe.
class RayCaster {
 public:
  explicit RayCaster(FieldEvaluator& fields) : fields_(fields) {}

  // If the request states bounds, a ray from outside starts at the point at which it enters them. RESOURCE_EXHAUSTED:
  // as for SurfaceIndexCache::get(). CANCELLED: the request was cancelled.
  absl::StatusOr<RayHits> cast(const SceneLease& scene, const RayRequest& request,
                               const FieldEvaluator::Cancelled& cancelled = {});

 private:
  FieldEvaluator& fields_;
  SurfaceIndexCache indices_;
};

}  // namespace isofield::engine
