// SurfaceProjector projects points onto the surface of a scene, along the field's gradient.
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
  double tolerance = 0;  // the largest residual that counts as on the surface; model units, > 0
};

// Each member has one number, or 3, for each point.
struct Projections {
  std::vector<float> positions;
  std::vector<float> normals;    // unit length, outward; 0, 0, 0 where the gradient vanishes
  std::vector<float> residuals;  // |f - iso| / |gradient| at the position, model units; infinite where it vanishes
  std::vector<std::uint8_t> converged;  // 1: the residual is at most the tolerance, or float32 can do no better
};

// Runs Newton's method on a function of the field that is nearly linear in the distance. A step that does not lead
// nearer to the surface is halved. All points of a batch take a step at once. Thread-safe.
class SurfaceProjector {
 public:
  explicit SurfaceProjector(FieldEvaluator& fields) : fields_(fields) {}

  // A point at which the gradient vanishes, such as one out of the reach of all primitives, stays where it is. Errors
  // are those of FieldEvaluator::evaluate().
  absl::StatusOr<Projections> project(const ResidentScene& scene, const ProjectionRequest& request,
                                      const FieldEvaluator::Cancelled& cancelled = {});

 private:
  FieldEvaluator& fields_;
};

}  // namespace isofield::engine
