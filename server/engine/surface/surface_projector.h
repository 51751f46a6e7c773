// Projects points onto the surface of a scene, along the field's gradient.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <vector>

#include "engine/points/field_evaluator.h"
#include "engine/surface/iso_level.h"

namespace isofield::engine {

struct ProjectionRequest {
  std::span<const float> points;  // 3 finite numbers a point
  double iso = 0.5;
  double tolerance = 0;  // model units, > 0: of the residual
};

// A number, or 3, a point.
struct Projections {
  std::vector<float> positions;
  std::vector<float> normals;    // unit length, outward; 0, 0, 0 where the gradient vanishes
  std::vector<float> residuals;  // |f - iso| / |gradient| at the position, model units; infinite where it vanishes
  std::vector<std::uint8_t> converged;  // 1: the residual is at most the tolerance, or float32 can do no better
};

// Newton's method on what the field says of the distance, held back where it does not get nearer; all points of a batch
// take a step at once. Thread-safe.
class SurfaceProjector {
 public:
  explicit SurfaceProjector(FieldEvaluator& fields) : fields_(fields) {}

  // A point where the gradient vanishes, such as one out of the reach of all primitives, stays where it is.
  absl::StatusOr<Projections> project(const ResidentScene& scene, const ProjectionRequest& request,
                                      const FieldEvaluator::Cancelled& cancelled = {});

 private:
  FieldEvaluator& fields_;
};

}  // namespace isofield::engine
