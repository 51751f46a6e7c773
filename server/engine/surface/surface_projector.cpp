#include "engine/surface/surface_projector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/status_macros.h"
#include "blobtree/geometry/vec3.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

constexpr int kMostSteps = 40;

// A function of the field that is 0 on the surface, and its derivative with respect to the field.
struct Depth {
  double value, slope;
};

// Returns r for the field f = (1 - r^2)^3 of a positive primitive. r is linear in the distance to the primitive, so
// that one step of Newton's method on r finds its surface from anywhere, whereas the field itself flattens out towards
// its ends. Above 0.99 the function goes straight on, since sums and blends lead beyond 1.
Depth radius_of(double f) {
  const double v = std::min(f, 0.99), root = std::cbrt(v), r = std::sqrt(1 - root);
  const double slope = -1 / (6 * root * root * r);
  return {r + slope * (f - v), slope};
}

Depth depth_of(double f, const IsoLevel& level) {
  if (level.law == operators::Law::kSigned) return {f - level.iso, 1};
  if (f <= 0) return {1, 0};
  const Depth radius = radius_of(f);
  return {radius.value - radius_of(level.iso).value, radius.slope};
}

// A point on its way to the surface.
struct PointWalker {
  std::uint32_t number;
  dvec3 at, step;  // the point where the field is evaluated next, and the step that led there
  dvec3 best;      // the nearest point so far, at which the step began
  double best_depth = std::numeric_limits<double>::infinity();
};

dvec3 rounded(const dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void store(std::vector<float>& rows, std::size_t i, const dvec3& v) {
  // Adding 0 turns -0 into 0, because a -0 means nothing to a client.
  rows[3 * i] = static_cast<float>(v.x) + 0.0f;
  rows[3 * i + 1] = static_cast<float>(v.y) + 0.0f;
  rows[3 * i + 2] = static_cast<float>(v.z) + 0.0f;
}

class Projection {
 public:
  Projection(const ResidentScene& scene, const ProjectionRequest& request)
      : request_(request), level_{request.iso, scene.tape().law}, count_(request.points.size() / 3) {
    result_.positions.assign(request.points.begin(), request.points.end());
    result_.normals.assign(3 * count_, 0);
    result_.residuals.assign(count_, std::numeric_limits<float>::infinity());
    result_.converged.assign(count_, 0);
    for (std::uint32_t i = 0; i < count_; ++i) {
      const dvec3 p{request.points[3 * i], request.points[3 * i + 1], request.points[3 * i + 2]};
      walkers_.push_back({i, p, {}, p});
    }
  }

  bool done() const { return walkers_.empty(); }
  Projections take_result() { return std::move(result_); }

  std::vector<float> points() const {
    std::vector<float> xyz(3 * walkers_.size());
    for (std::size_t n = 0; n < walkers_.size(); ++n) store(xyz, n, walkers_[n].at);
    return xyz;
  }

  // Moves every walker by a step. `fields` has the value and the gradient at points().
  void advance(const ResultRows& fields) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < walkers_.size(); ++n) {
      const auto [gx, gy, gz] = fields.gradient(n);
      if (advance(walkers_[n], fields.value(n), {gx, gy, gz})) walkers_[kept++] = walkers_[n];
    }
    walkers_.resize(kept);
  }

 private:
  // Returns false if the walker has arrived, or can get no further.
  bool advance(PointWalker& w, double f, const dvec3& gradient) {
    const Depth depth = depth_of(f, level_);
    const double size = std::abs(depth.value), slope = length(gradient);
    const dvec3 begin = w.best;
    if (!(slope * std::abs(depth.slope) > 0)) {
      // The point stepped out of the field's reach, or never was in it.
      return w.best_depth < std::numeric_limits<double>::infinity() && halve(w, begin);
    }
    // The step did not lead nearer. Half of it crosses no more of the surface than the whole.
    if (!(size < w.best_depth) && size > 0) return halve(w, begin);
    w.best = w.at;
    w.best_depth = size;
    const double residual = std::abs(level_.excess(f)) / slope;
    store(result_.positions, w.number, w.at);
    store(result_.normals, w.number, gradient * (-level_.inward() / slope));
    result_.residuals[w.number] = static_cast<float>(residual);
    if (residual <= request_.tolerance) {
      result_.converged[w.number] = 1;
      return false;
    }
    w.step = gradient * (-depth.value / (depth.slope * slope * slope));
    w.at = rounded(w.best + w.step);
    return settle(w);
  }

  bool halve(PointWalker& w, const dvec3& begin) {
    w.step = w.step * 0.5;
    w.at = rounded(begin + w.step);
    return settle(w);
  }

  // Returns false if float32 has no point that is nearer to the surface.
  bool settle(PointWalker& w) {
    const bool moves = w.at != w.best;
    const dvec3& b = w.best;
    const double resolution = 0x1p-22 * std::max({std::abs(b.x), std::abs(b.y), std::abs(b.z)});
    if (!moves) result_.converged[w.number] = result_.residuals[w.number] <= std::max(request_.tolerance, resolution);
    return moves;
  }

  const ProjectionRequest& request_;
  const IsoLevel level_;
  const std::size_t count_;
  std::vector<PointWalker> walkers_;
  Projections result_;
};

}  // namespace

absl::StatusOr<Projections> SurfaceProjector::project(const ResidentScene& scene, const ProjectionRequest& request,
                                                      const FieldEvaluator::Cancelled& cancelled) {
  constexpr ResultLayout kLayout = ResultLayout::kValueAndGradient;
  Projection projection(scene, request);
  for (int step = 0; step < kMostSteps && !projection.done(); ++step) {
    const std::vector<float> xyz = projection.points();
    std::vector<float> fields(kLayout.numbers(xyz.size() / 3));
    ISOFIELD_RETURN_IF_ERROR(fields_.evaluate(scene, xyz, kLayout, fields, cancelled));
    projection.advance(ResultRows(kLayout, fields));
  }
  return projection.take_result();
}

}  // namespace isofield::engine
