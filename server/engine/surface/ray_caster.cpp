#include "engine/surface/ray_caster.h"

#include <algorithm>
#include <cmath>

#include "base/status_macros.h"
#include "blobtree/cull/nearest_leaf.h"
#include "engine/surface/bracketed_root.h"
#include "engine/surface/iso_level.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;
using blobtree::Ray;
using blobtree::RaySpan;

dvec3 vec3_at(std::span<const float> numbers, std::size_t i) {
  return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

void append(std::vector<float>& xyz, const dvec3& p) {
  xyz.insert(xyz.end(), {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
}

// A ray that has not met the surface yet.
struct RayWalker {
  std::uint32_t number;  // the ray's number in the batch
  Ray ray;               // its direction has unit length
  RaySpan ahead;         // the stretch that is still to be walked
  double start;          // the point at which the field is evaluated first
  double last;           // the point at which the field was evaluated last
  double excess;         // IsoLevel::excess at `last`
  bool is_inside;
};

struct Crossing {
  std::uint32_t number;
  Ray ray;
  BracketedRoot root;
};

class Cast {
 public:
  Cast(FieldEvaluator& fields, const ResidentScene& scene, const RayRequest& request, const SurfaceIndex& index,
       const FieldEvaluator::Cancelled& cancelled)
      : fields_(fields), scene_(scene), request_(request), index_(index), cancelled_(cancelled) {
    level_ = {request.surface.iso, scene.tape().law};
    const blobtree::Box& b = index.box;
    const double reach = std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.min.z), std::abs(b.max.x),
                                   std::abs(b.max.y), std::abs(b.max.z)});
    // A tolerance finer than the steps of float32 would gain nothing.
    tolerance_ = std::max(kRayTolerance * index.cell_size, 0x1p-23 * reach);
  }

  absl::StatusOr<RayHits> run() {
    const std::size_t count = request_.origins.size() / 3;
    hits_.distances.assign(count, std::numeric_limits<float>::infinity());
    hits_.positions.assign(3 * count, 0);
    hits_.normals.assign(3 * count, 0);
    hits_.nodes.assign(count, RayHits::kNoNode);
    hits_.inside.assign(count, 0);
    hits_.cell_size = index_.cell_size;
    if (scene_.tape().support.empty()) return std::move(hits_);
    const std::size_t most = fields_.profile().rays;
    for (std::size_t first = 0; first < count; first += most) {
      ISOFIELD_RETURN_IF_ERROR(start(first, std::min(first + most, count)));
      while (!walkers_.empty()) ISOFIELD_RETURN_IF_ERROR(advance());
      while (std::any_of(crossings_.begin(), crossings_.end(), [](const Crossing& c) { return !c.root.done(); })) {
        ISOFIELD_RETURN_IF_ERROR(narrow());
      }
      ISOFIELD_RETURN_IF_ERROR(describe());
      crossings_.clear();
    }
    return std::move(hits_);
  }

 private:
  // Finds the rays that come near the scene, and whether each of them begins inside.
  absl::Status start(std::size_t first, std::size_t end) {
    xyz_.clear();
    const std::size_t before = walkers_.size();
    for (std::size_t i = first; i < end; ++i) {
      const dvec3 direction = vec3_at(request_.directions, i);
      const Ray ray{vec3_at(request_.origins, i), direction * (1 / length(direction))};
      const RaySpan ahead = clip(ray, index_.box, {0, request_.max_distance});
      if (ahead.empty()) continue;
      walkers_.push_back({static_cast<std::uint32_t>(i), ray, ahead, ahead.begin, ahead.begin, 0, false});
      append(xyz_, ray.point(ahead.begin));
    }
    ISOFIELD_RETURN_IF_ERROR(evaluate());
    for (std::size_t n = before; n < walkers_.size(); ++n) {
      RayWalker& w = walkers_[n];
      w.excess = level_.excess(values_[n - before]);
      w.is_inside = w.excess > 0;
      hits_.inside[w.number] = w.is_inside;
    }
    return absl::OkStatus();
  }

  // Runs one round: every ray advances by some bricks.
  absl::Status advance() {
    const gpu::DeviceProfile& most = fields_.profile();
    const std::size_t bricks =
        std::clamp<std::size_t>(most.round_bricks / walkers_.size(), 1, most.round_bricks_per_ray);
    xyz_.clear();
    samples_.clear();
    std::vector<std::size_t> ends;  // the end of each walker's samples
    std::vector<bool> is_last;
    for (RayWalker& w : walkers_) {
      spans_.clear();
      is_last.push_back(index_.tree.walk(w.ray, w.ahead, bricks, spans_) < bricks);
      look_through(w, is_last.back());
      ends.push_back(samples_.size());
    }
    ISOFIELD_RETURN_IF_ERROR(evaluate());
    std::size_t kept = 0, at = 0;
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      RayWalker& w = walkers_[i];
      const bool has_crossed = cross(w, at, ends[i]);
      at = ends[i];
      if (!has_crossed && !is_last[i]) walkers_[kept++] = w;
    }
    walkers_.resize(kept);
    return absl::OkStatus();
  }

  // Samples a walker's new spans at their ends and, in between, at multiples of a cell from its start. So the samples
  // are the same however far the ray gets in a round, which depends on the batch. Spans of two rounds may touch.
  void look_through(RayWalker& w, bool is_last) {
    double last = w.last;
    const auto sample_at = [&](double t) {
      if (t > last) sample(w.ray, last = t);
    };
    for (const RaySpan& span : spans_) {
      if (span.begin != w.ahead.begin) {
        sample_at(w.ahead.begin);
        sample_at(span.begin);
      }
      const double cell = index_.cell_size;
      for (double n = std::floor((last - w.start) / cell) + 1; w.start + n * cell < span.end; ++n) {
        sample_at(w.start + n * cell);
      }
      w.ahead.begin = span.end;
    }
    if (is_last) sample_at(w.ahead.begin);
  }

  void sample(const Ray& ray, double t) {
    samples_.push_back(t);
    append(xyz_, ray.point(t));
  }

  // Looks through a walker's samples of this round; returns true if it has crossed the surface.
  bool cross(RayWalker& w, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const double excess = level_.excess(values_[n]);
      if ((excess > 0) != w.is_inside) {
        crossings_.push_back({w.number, w.ray, {w.last, samples_[n], w.excess, excess, tolerance_}});
        return true;
      }
      w.last = samples_[n];
      w.excess = excess;
    }
    return false;
  }

  // Runs one round: every crossing is bracketed more narrowly.
  absl::Status narrow() {
    xyz_.clear();
    for (Crossing& c : crossings_) {
      if (!c.root.done()) append(xyz_, c.ray.point(c.root.next()));
    }
    ISOFIELD_RETURN_IF_ERROR(evaluate());
    std::size_t n = 0;
    for (Crossing& c : crossings_) {
      if (!c.root.done()) c.root.take(level_.excess(values_[n++]));
    }
    return absl::OkStatus();
  }

  // Finds position, normal and node of every hit.
  absl::Status describe() {
    xyz_.clear();
    for (const Crossing& c : crossings_) append(xyz_, c.ray.point(c.root.root()));
    constexpr ResultLayout kLayout = ResultLayout::kValueAndGradient;
    std::vector<float> fields(kLayout.numbers(crossings_.size()));
    ISOFIELD_RETURN_IF_ERROR(fields_.evaluate(scene_, xyz_, kLayout, fields, cancelled_));
    const ResultRows rows(kLayout, fields);
    const std::vector<std::uint32_t> leaves = blobtree::nearest_leaves(scene_.tape(), xyz_);
    for (std::size_t n = 0; n < crossings_.size(); ++n) {
      const Crossing& c = crossings_[n];
      hits_.distances[c.number] = static_cast<float>(std::max(c.root.root(), 0.0));
      std::copy_n(&xyz_[3 * n], 3, &hits_.positions[3 * std::size_t{c.number}]);
      const auto [gx, gy, gz] = rows.gradient(n);
      const dvec3 outward = dvec3{gx, gy, gz} * -level_.inward();
      const double slope = length(outward);
      // If the gradient vanishes, the normal lies along the ray and faces outwards.
      const dvec3 normal = slope > 0 ? outward * (1 / slope) : c.ray.direction * (hits_.inside[c.number] ? 1.0 : -1.0);
      float* const out = &hits_.normals[3 * std::size_t{c.number}];
      // Adding 0 turns -0 into 0, because a -0 means nothing to a client.
      out[0] = static_cast<float>(normal.x) + 0.0f;
      out[1] = static_cast<float>(normal.y) + 0.0f;
      out[2] = static_cast<float>(normal.z) + 0.0f;
      if (leaves[n] != blobtree::kNoLeaf) hits_.nodes[c.number] = scene_.tape().leaves[leaves[n]].node;
    }
    return absl::OkStatus();
  }

  absl::Status evaluate() {
    values_.resize(xyz_.size() / 3);
    return fields_.evaluate(scene_, xyz_, ResultLayout::kValue, values_, cancelled_);
  }

  FieldEvaluator& fields_;
  const ResidentScene& scene_;
  const RayRequest& request_;
  const SurfaceIndex& index_;
  const FieldEvaluator::Cancelled& cancelled_;
  IsoLevel level_;
  double tolerance_ = 0;
  RayHits hits_;

  std::vector<RayWalker> walkers_;
  std::vector<Crossing> crossings_;
  // The spans, sample places, points and values of the present round.
  std::vector<RaySpan> spans_;
  std::vector<double> samples_;
  std::vector<float> xyz_, values_;
};

}  // namespace

absl::StatusOr<RayHits> RayCaster::cast(const SceneLease& scene, const RayRequest& request,
                                        const FieldEvaluator::Cancelled& cancelled) {
  ISOFIELD_ASSIGN_OR_RETURN(const auto index, indices_.get(scene, request.surface, cancelled));
  return Cast(fields_, *scene, request, *index, cancelled).run();
}

}  // namespace isofield::engine
