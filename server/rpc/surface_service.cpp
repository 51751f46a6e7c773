#include "rpc/surface_service.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "base/status_macros.h"
#include "engine/surface/iso_level.h"
#include "engine/surface/slicer.h"
#include "rpc/answer_limit.h"
#include "rpc/geometry_arguments.h"
#include "rpc/slice_plane.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

constexpr int kMaxLevels = 64;
// The tolerance of a projection that states none, as a part of the longest edge of the supports.
constexpr double kProjectionTolerance = 1e-5;

constexpr RowArray::Words kPoints{"points", "points", "send them in parts"};

// Checks that there are as many origins as directions, that the coordinates of origins are within their limit, and that
// no direction is 0.
absl::Status check_rays(const PointArray& origins, const PointArray& directions) {
  if (origins.size() != directions.size()) {
    return absl::InvalidArgumentError(absl::StrCat("directions.shape = [", directions.size(),
                                                   ", 3]: expected as many rows as origins has, ", origins.size()));
  }
  for (std::size_t i = 0; i < origins.xyz().size(); ++i) {
    if (!(std::abs(origins.xyz()[i]) <= base::kMaxCoordinate)) {
      return absl::InvalidArgumentError(absl::StrCat("origins[", i / 3, "].", std::string(1, "xyz"[i % 3]), " = ",
                                                     origins.xyz()[i], ": expected a magnitude of at most ",
                                                     base::kMaxCoordinate));
    }
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const float* d = &directions.xyz()[3 * i];
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) {
      return absl::InvalidArgumentError(
          absl::StrCat("directions[", i, "] = (0, 0, 0): expected a direction of any length but 0"));
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<engine::SurfaceRequest> read_surface(const v1::CastRaysRequest& request, const blobtree::Tape& tape,
                                                    const Limits& limits) {
  engine::SurfaceRequest r{.max_cells = limits.max_mesh_cells};
  ISOFIELD_ASSIGN_OR_RETURN(r.bounds, read_bounds(request.bounds_min(), request.bounds_max()));
  ISOFIELD_ASSIGN_OR_RETURN(r.iso, read_iso(request, tape.law));
  ISOFIELD_RETURN_IF_ERROR(check_bounded(tape, r.bounds, r.iso));
  if (request.has_cell_size()) {
    ISOFIELD_ASSIGN_OR_RETURN(r.cell_size, read_length("cell_size", request.cell_size()));
  }
  return r;
}

// Fills the response's list of names with the nodes that were hit, and turns indices of nodes into indices in that
// list.
void set_names(const v1::Scene& scene, std::vector<std::uint32_t>& nodes, v1::CastRaysResponse& response) {
  std::vector<std::uint32_t> hit = nodes;
  std::sort(hit.begin(), hit.end());
  hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
  if (!hit.empty() && hit.back() == engine::RayHits::kNoNode) hit.pop_back();
  for (const std::uint32_t node : hit) response.add_names(scenes::node_name(scene, node));
  for (std::uint32_t& node : nodes) {
    if (node == engine::RayHits::kNoNode) continue;
    node = static_cast<std::uint32_t>(std::lower_bound(hit.begin(), hit.end(), node) - hit.begin());
  }
}

absl::StatusOr<double> read_max_distance(const v1::CastRaysRequest& request, double otherwise) {
  if (!request.has_max_distance()) return otherwise;
  if (request.max_distance() > 0) return request.max_distance();
  return absl::InvalidArgumentError(
      absl::StrCat("max_distance = ", request.max_distance(), ": expected a length > 0, or none"));
}

void write_hits(engine::RayHits hits, const v1::Scene& scene, v1::CastRaysResponse& response) {
  set_names(scene, hits.nodes, response);
  set_rows(std::span<const float>(hits.distances), 1, *response.mutable_distances());
  set_rows(std::span<const float>(hits.positions), 3, *response.mutable_positions());
  set_rows(std::span<const float>(hits.normals), 3, *response.mutable_normals());
  set_rows(std::span<const std::uint32_t>(hits.nodes), 1, *response.mutable_nodes());
  set_rows(std::span<const std::uint8_t>(hits.inside), 1, *response.mutable_inside());
  response.set_cell_size(hits.cell_size);
}

absl::StatusOr<double> read_tolerance(const v1::ProjectPointsRequest& request, const blobtree::Tape& tape) {
  if (request.has_tolerance()) return read_length("tolerance", request.tolerance());
  if (const std::optional<double> edge = longest_support_edge(tape)) return kProjectionTolerance * *edge;
  return absl::InvalidArgumentError(
      "tolerance: expected, since the operators of this scene do not bound its field by themselves");
}

absl::Status check_levels(const v1::SliceRequest& request) {
  if (request.levels_size() > kMaxLevels) {
    return absl::InvalidArgumentError(
        absl::StrCat("levels holds ", request.levels_size(), " numbers: expected at most ", kMaxLevels));
  }
  for (int i = 0; i < request.levels_size(); ++i) {
    if (!std::isfinite(static_cast<float>(request.levels(i)))) {
      return absl::InvalidArgumentError(
          absl::StrCat("levels[", i, "] = ", request.levels(i), ": expected a finite float32"));
    }
  }
  return absl::OkStatus();
}

void write_slice(const engine::Slice& slice, const engine::Plane& plane, const std::vector<double>& levels,
                 v1::SliceResponse& response) {
  set_rows(std::span(slice.values), plane.counts[0], *response.mutable_values());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    v1::LevelCurves& curves = *response.add_curves();
    curves.set_level(levels[i]);
    set_rows(std::span(slice.lines[i].points), 2, *curves.mutable_points());
    curves.mutable_starts()->set_dtype(v1::Tensor::UINT32);
    curves.mutable_starts()->add_shape(slice.lines[i].starts.size());
    curves.mutable_starts()->set_data(slice.lines[i].starts.data(), 4 * slice.lines[i].starts.size());
  }
  set_vector(plane.u, *response.mutable_u());
  set_vector(plane.v, *response.mutable_v());
  set_vector(plane.origin, *response.mutable_origin());
  for (const double spacing : plane.spacing) response.add_spacing(spacing);
}

}  // namespace

absl::Status SurfaceService::cast(Call& call, const v1::CastRaysRequest& request, v1::CastRaysResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  const std::uint64_t most = limits_.max_points_per_message;
  ISOFIELD_ASSIGN_OR_RETURN(const PointArray origins,
                            PointArray::read(request.origins(), most, {"origins", "rays", "send them in parts"}));
  ISOFIELD_ASSIGN_OR_RETURN(const PointArray directions,
                            PointArray::read(request.directions(), most, {"directions", "rays", "send them in parts"}));
  ISOFIELD_RETURN_IF_ERROR(check_rays(origins, directions));
  ISOFIELD_RETURN_IF_ERROR(check_answer_rows(request, origins.size(), 33));
  engine::RayRequest r{.origins = origins.xyz(), .directions = directions.xyz()};
  ISOFIELD_ASSIGN_OR_RETURN(r.surface, read_surface(request, leased.scene->tape(), limits_));
  ISOFIELD_ASSIGN_OR_RETURN(r.max_distance, read_max_distance(request, r.max_distance));
  ISOFIELD_RETURN_IF_ERROR(call.admit(origins.size()));
  ISOFIELD_ASSIGN_OR_RETURN(engine::RayHits hits, engine_.rays().cast(leased.scene, r, call.cancelled()));
  write_hits(std::move(hits), *leased.message, response);
  response.set_scene_version(leased.version);
  return absl::OkStatus();
}

absl::Status SurfaceService::project(Call& call, const v1::ProjectPointsRequest& request,
                                     v1::ProjectPointsResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const PointArray points,
                            PointArray::read(request.points(), limits_.max_points_per_message, kPoints));
  const blobtree::Tape& tape = leased.scene->tape();
  ISOFIELD_RETURN_IF_ERROR(check_answer_rows(request, points.size(), 29));
  engine::ProjectionRequest r{.points = points.xyz()};
  ISOFIELD_ASSIGN_OR_RETURN(r.iso, read_iso(request, tape.law));
  ISOFIELD_ASSIGN_OR_RETURN(r.tolerance, read_tolerance(request, tape));
  ISOFIELD_RETURN_IF_ERROR(call.admit(points.size()));
  ISOFIELD_ASSIGN_OR_RETURN(const engine::Projections found,
                            engine_.projector().project(*leased.scene, r, call.cancelled()));
  set_rows(std::span(found.positions), 3, *response.mutable_positions());
  set_rows(std::span(found.normals), 3, *response.mutable_normals());
  set_rows(std::span(found.converged), 1, *response.mutable_converged());
  set_rows(std::span(found.residuals), 1, *response.mutable_residuals());
  return absl::OkStatus();
}

absl::Status SurfaceService::contains(Call& call, const v1::ContainsRequest& request, v1::ContainsResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const PointArray points,
                            PointArray::read(request.points(), limits_.max_points_per_message, kPoints));
  ISOFIELD_RETURN_IF_ERROR(check_answer_rows(request, points.size(), 1));
  engine::IsoLevel level{.law = leased.scene->tape().law};
  ISOFIELD_ASSIGN_OR_RETURN(level.iso, read_iso(request, level.law));
  ISOFIELD_RETURN_IF_ERROR(call.admit(points.size()));
  std::vector<float> values(points.size());
  ISOFIELD_RETURN_IF_ERROR(
      engine_.fields().evaluate(*leased.scene, points.xyz(), engine::ResultLayout::kValue, values, call.cancelled()));
  std::vector<std::uint8_t> inside(values.size());
  std::transform(values.begin(), values.end(), inside.begin(), [&](float f) { return level.excess(f) > 0 ? 1 : 0; });
  set_rows(std::span<const std::uint8_t>(inside), 1, *response.mutable_inside());
  return absl::OkStatus();
}

absl::Status SurfaceService::slice(Call& call, const v1::SliceRequest& request, v1::SliceResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const engine::Plane plane,
                            read_plane(request, leased.scene->tape(), limits_.max_points_per_message));
  ISOFIELD_RETURN_IF_ERROR(check_levels(request));
  const std::uint64_t samples = std::uint64_t{plane.counts[0]} * plane.counts[1];
  ISOFIELD_RETURN_IF_ERROR(AnswerLimit(request.max_answer_bytes()).admit(samples * sizeof(float), kSmallerPlane));
  std::vector<double> levels(request.levels().begin(), request.levels().end());
  if (levels.empty()) {
    ISOFIELD_ASSIGN_OR_RETURN(const double surface, read_iso(std::optional<double>(), leased.scene->tape().law));
    levels.push_back(surface);
  }
  ISOFIELD_RETURN_IF_ERROR(call.admit(samples));
  ISOFIELD_ASSIGN_OR_RETURN(const engine::Slice slice,
                            engine::slice(engine_.fields(), *leased.scene, plane, levels, call.cancelled()));
  write_slice(slice, plane, levels, response);
  return absl::OkStatus();
}

}  // namespace isofield::rpc
