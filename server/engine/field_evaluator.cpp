#include "engine/field_evaluator.h"

#include <algorithm>
#include <array>

#include "blobtree/point_bins.h"
#include "engine/session.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;

// Points of a workgroup: a multiple of points.comp's local size, small enough to spread over the device.
constexpr std::uint32_t kPointsPerGroup = 256;

using PointJob = std::array<std::uint32_t, 4>;

std::vector<PointJob> point_jobs(const blobtree::PointBins& bins) {
  std::vector<PointJob> jobs;
  for (const blobtree::PointGroup& g : bins.groups) {
    for (std::uint32_t at = 0; at < g.count; at += kPointsPerGroup) {
      jobs.push_back({g.tape_begin, g.tape_count, g.first + at, std::min(kPointsPerGroup, g.count - at)});
    }
  }
  return jobs;
}

struct GridConstants {
  float origin[4];
  float spacing[4];
  std::uint32_t counts[3];
  std::uint32_t first_brick;
  std::uint32_t first_layer;
  std::uint32_t layers;
};

}  // namespace

absl::Status FieldEvaluator::evaluate(const ResidentScene& scene, std::span<const float> xyz, Quantity quantity,
                                      std::span<float> out) {
  const std::size_t count = xyz.size() / 3;
  if (count == 0) return absl::OkStatus();
  const blobtree::PointBins bins = blobtree::bin_points(scene.tape(), xyz);
  const std::vector<PointJob> jobs = point_jobs(bins);
  if (jobs.empty()) {
    std::fill(out.begin(), out.end(), 0.0f);
    return absl::OkStatus();
  }
  ISOFIELD_ASSIGN_OR_RETURN(
      const gpu::Pipeline* kernel,
      kernels_.get(quantity == Quantity::kValue ? shaders::kPointsValue : shaders::kPointsGradient,
                   KernelKind::of(scene.tape())));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer code, session.upload(std::span(bins.code)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer job_buffer, session.upload(std::span(jobs)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer order, session.upload(std::span(bins.order)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer points, session.upload(xyz));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer results, session.scratch(out.size_bytes()));
  // Points that were culled away have no job, and the field 0.
  std::uint64_t covered = 0;
  for (const blobtree::PointGroup& g : bins.groups) covered += g.count;
  if (covered < count) {
    session.commands().fill_zero(results);
    session.commands().barrier();
  }
  for (std::size_t at = 0; at < jobs.size(); at += gpu::kMaxGroups) {
    const std::array<std::uint32_t, 2> constants{static_cast<std::uint32_t>(at), bins.order.empty() ? 0u : 1u};
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        *kernel, scene.bindings(code, {{4, &job_buffer}, {5, &order}, {6, &points}, {7, &results}}), constants,
        static_cast<std::uint32_t>(std::min<std::size_t>(jobs.size() - at, gpu::kMaxGroups))));
  }
  ISOFIELD_RETURN_IF_ERROR(session.download(results, out));
  return session.run();
}

absl::Status FieldEvaluator::evaluate_layers(const ResidentScene& scene, const blobtree::Lattice& lattice,
                                             std::uint32_t first_layer, Quantity quantity, std::span<float> out) {
  const std::size_t layer = std::size_t{lattice.cells[0]} * lattice.cells[1] * components(quantity);
  const auto layers = static_cast<std::uint32_t>(out.size() / layer);
  // Culled as a lattice of its own; the device numbers points in the whole one, so that they are the same bits.
  blobtree::CullRequest part{.lattice = lattice, .keep = blobtree::Keep::kSupport};
  part.lattice.origin.z += lattice.spacing.z * first_layer;
  part.lattice.cells[2] = layers;
  ISOFIELD_ASSIGN_OR_RETURN(blobtree::BrickList bricks, blobtree::cull(scene.tape(), part));
  std::vector<Brick>& wanted = bricks.bricks;
  for (Brick& b : wanted) b.z += first_layer / blobtree::kBrickCells;
  if (wanted.empty()) {
    std::fill(out.begin(), out.end(), 0.0f);
    return absl::OkStatus();
  }
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel,
                            kernels_.get(quantity == Quantity::kValue ? shaders::kGridValue : shaders::kGridGradient,
                                         KernelKind::of(scene.tape())));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer code, session.upload(std::span(bricks.code)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer brick_buffer, session.upload(std::span(wanted)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer results, session.scratch(out.size_bytes()));
  session.commands().fill_zero(results);
  session.commands().barrier();
  GridConstants constants{{static_cast<float>(lattice.origin.x), static_cast<float>(lattice.origin.y),
                           static_cast<float>(lattice.origin.z)},
                          {static_cast<float>(lattice.spacing.x), static_cast<float>(lattice.spacing.y),
                           static_cast<float>(lattice.spacing.z)},
                          {lattice.cells[0], lattice.cells[1], lattice.cells[2]},
                          0,
                          first_layer,
                          layers};
  for (std::size_t at = 0; at < wanted.size(); at += gpu::kMaxGroups) {
    constants.first_brick = static_cast<std::uint32_t>(at);
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
        *kernel, scene.bindings(code, {{4, &brick_buffer}, {7, &results}}), constants,
        static_cast<std::uint32_t>(std::min<std::size_t>(wanted.size() - at, gpu::kMaxGroups))));
  }
  ISOFIELD_RETURN_IF_ERROR(session.download(results, out));
  return session.run();
}

}  // namespace isofield::engine
