#include "engine/surface/slicer.h"

#include "base/status_macros.h"

namespace isofield::engine {

absl::StatusOr<Slice> slice(FieldEvaluator& fields, const ResidentScene& scene, const Plane& plane,
                            std::span<const double> levels, const FieldEvaluator::Cancelled& cancelled) {
  const auto [columns, rows] = plane.counts;
  std::vector<float> xyz;
  xyz.reserve(std::size_t{3} * columns * rows);
  for (std::uint32_t j = 0; j < rows; ++j) {
    const blobtree::dvec3 row = plane.origin + plane.v * (j * plane.spacing[1]);
    for (std::uint32_t i = 0; i < columns; ++i) {
      const blobtree::dvec3 p = row + plane.u * (i * plane.spacing[0]);
      xyz.insert(xyz.end(), {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
  }
  Slice result;
  result.values.resize(std::size_t{columns} * rows);
  ISOFIELD_RETURN_IF_ERROR(fields.evaluate(scene, xyz, ResultLayout::kValue, result.values, cancelled));
  for (const double level : levels) {
    if (cancelled && cancelled()) return absl::CancelledError("the request was cancelled");
    Polylines lines = iso_lines(result.values, plane.counts, static_cast<float>(level));
    for (std::size_t i = 0; i < lines.points.size(); ++i) {
      lines.points[i] = static_cast<float>(lines.points[i] * plane.spacing[i % 2]);
    }
    result.lines.push_back(std::move(lines));
  }
  return result;
}

}  // namespace isofield::engine
