// Evaluates the field of a scene on a plane, and finds its level curves there.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <span>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "engine/points/field_evaluator.h"
#include "engine/surface/iso_lines.h"

namespace isofield::engine {

// The points origin + (i spacing[0]) u + (j spacing[1]) v, which are computed in double and rounded to float32.
struct Plane {
  blobtree::dvec3 origin, u, v;  // u and v have unit length
  std::array<double, 2> spacing{};
  std::array<std::uint32_t, 2> counts{};
};

struct Slice {
  std::vector<float> values;     // i fastest
  std::vector<Polylines> lines;  // for each level, in model units along u and v from the origin
};

// Errors are those of FieldEvaluator::evaluate().
absl::StatusOr<Slice> slice(FieldEvaluator& fields, const ResidentScene& scene, const Plane& plane,
                            std::span<const double> levels, const FieldEvaluator::Cancelled& cancelled = {});

}  // namespace isofield::engine
