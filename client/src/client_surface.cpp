#include <absl/strings/str_cat.h>

#include <algorithm>
#include <map>

#include "client_impl.h"
#include "tensor.h"

namespace isofield {
namespace {

absl::Status check_rows(const char* what, std::span<const float> numbers) {
  if (numbers.size() % 3 == 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(what, ": ", numbers.size(), " coordinates; expected a multiple of 3 (x, y, z of each)"));
}

// Calls `ask` with the first row and the number of rows of each part; a part has at most kChunkPoints rows. Calls it
// once at least, so that the server sees the rest of the request.
template <class Ask>
absl::Status in_parts(std::size_t rows, const Ask& ask) {
  for (std::size_t first = 0;; first += Client::kChunkPoints) {
    const std::size_t count = std::min(Client::kChunkPoints, rows - first);
    if (auto status = ask(first, count); !status.ok()) {
      if (first == 0) return status;
      return absl::Status(status.code(), absl::StrCat("after ", first, " rows: ", status.message()));
    }
    if (first + count >= rows) return absl::OkStatus();
  }
}

absl::Status check_answered(std::size_t answered, std::size_t expected) {
  if (answered == expected) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("the server answered ", answered, " of ", expected, " rows"));
}

// Appends the rows of an answer to `hits`. `places` has the index of each name in hits.names.
absl::Status append_hits(const v1::CastRaysResponse& response, std::map<std::string, std::uint32_t>& places,
                         RayHits& hits) {
  absl::Status status;
  status.Update(append_floats(response.distances(), 1, hits.distances));
  status.Update(append_floats(response.positions(), 3, hits.positions));
  status.Update(append_floats(response.normals(), 3, hits.normals));
  status.Update(append_bytes(response.inside(), 1, hits.inside));
  std::vector<std::uint32_t> nodes;
  status.Update(append_indices(response.nodes(), 1, nodes));
  if (!status.ok()) return status;
  // Each answer lists the names that it needs, and numbers them by itself.
  std::vector<std::uint32_t> joined;
  for (const std::string& name : response.names()) {
    const auto [it, is_new] = places.emplace(name, static_cast<std::uint32_t>(hits.names.size()));
    if (is_new) hits.names.push_back(name);
    joined.push_back(it->second);
  }
  for (const std::uint32_t node : nodes) {
    if (node != RayHits::kNothing && node >= joined.size()) {
      return absl::InternalError(absl::StrCat("the server sent node ", node, " of ", joined.size(), " names"));
    }
    hits.nodes.push_back(node == RayHits::kNothing ? node : joined[node]);
  }
  hits.cell_size = response.cell_size();
  return absl::OkStatus();
}

absl::Status read_curves(const v1::LevelCurves& message, LevelCurves& curves) {
  curves.level = message.level();
  absl::Status status = append_floats(message.points(), 2, curves.points);
  const std::uint64_t starts = message.starts().shape_size() == 1 ? message.starts().shape(0) : 0;
  status.Update(append_indices(message.starts(), starts, curves.starts));
  if (!status.ok()) return status;
  const bool fits = !curves.starts.empty() && std::is_sorted(curves.starts.begin(), curves.starts.end()) &&
                    curves.starts.front() == 0 && curves.starts.back() == curves.points.size() / 2;
  return fits ? status : absl::InternalError("the server sent polylines whose starts do not fit their points");
}

}  // namespace

absl::StatusOr<RayHits> Client::cast_rays(v1::CastRaysRequest request, std::span<const float> origins,
                                          std::span<const float> directions) {
  if (auto status = check_rows("origins", origins); !status.ok()) return status;
  if (origins.size() != directions.size()) {
    return absl::InvalidArgumentError(absl::StrCat("directions: ", directions.size(), " coordinates; expected ",
                                                   origins.size(), ", as many as the origins have"));
  }
  request.set_max_answer_bytes(kMaxAnswerBytes);
  RayHits hits;
  std::map<std::string, std::uint32_t> places;
  const auto status = in_parts(origins.size() / 3, [&](std::size_t first, std::size_t count) {
    set_points(origins.subspan(3 * first, 3 * count), *request.mutable_origins());
    set_points(directions.subspan(3 * first, 3 * count), *request.mutable_directions());
    v1::CastRaysResponse response;
    absl::Status asked = impl_->retry([&] {
      return impl_->call(
          [&](grpc::ClientContext* context) { return impl_->surfaces->CastRays(context, request, &response); });
    });
    if (asked.ok()) asked = append_hits(response, places, hits);
    const std::size_t rows = std::min({hits.distances.size(), hits.positions.size() / 3, hits.normals.size() / 3,
                                       hits.nodes.size(), hits.inside.size()});
    if (asked.ok()) asked = check_answered(rows, first + count);
    return asked;
  });
  if (!status.ok()) return status;
  return hits;
}

absl::StatusOr<Projections> Client::project(v1::ProjectPointsRequest request, std::span<const float> xyz) {
  if (auto status = check_rows("points", xyz); !status.ok()) return status;
  request.set_max_answer_bytes(kMaxAnswerBytes);
  Projections all;
  const auto status = in_parts(xyz.size() / 3, [&](std::size_t first, std::size_t count) {
    set_points(xyz.subspan(3 * first, 3 * count), *request.mutable_points());
    v1::ProjectPointsResponse response;
    absl::Status asked = impl_->retry([&] {
      return impl_->call(
          [&](grpc::ClientContext* context) { return impl_->surfaces->ProjectPoints(context, request, &response); });
    });
    if (!asked.ok()) return asked;
    asked.Update(append_floats(response.positions(), 3, all.positions));
    asked.Update(append_floats(response.normals(), 3, all.normals));
    asked.Update(append_bytes(response.converged(), 1, all.converged));
    asked.Update(append_floats(response.residuals(), 1, all.residuals));
    const std::size_t rows =
        std::min({all.positions.size() / 3, all.normals.size() / 3, all.converged.size(), all.residuals.size()});
    asked.Update(check_answered(rows, first + count));
    return asked;
  });
  if (!status.ok()) return status;
  return all;
}

absl::StatusOr<std::vector<std::uint8_t>> Client::contains(v1::ContainsRequest request, std::span<const float> xyz) {
  if (auto status = check_rows("points", xyz); !status.ok()) return status;
  request.set_max_answer_bytes(kMaxAnswerBytes);
  std::vector<std::uint8_t> inside;
  const auto status = in_parts(xyz.size() / 3, [&](std::size_t first, std::size_t count) {
    set_points(xyz.subspan(3 * first, 3 * count), *request.mutable_points());
    v1::ContainsResponse response;
    absl::Status asked = impl_->retry([&] {
      return impl_->call(
          [&](grpc::ClientContext* context) { return impl_->surfaces->Contains(context, request, &response); });
    });
    if (!asked.ok()) return asked;
    asked.Update(append_bytes(response.inside(), 1, inside));
    asked.Update(check_answered(inside.size(), first + count));
    return asked;
  });
  if (!status.ok()) return status;
  return inside;
}

absl::StatusOr<Slice> Client::slice(v1::SliceRequest request) {
  request.set_max_answer_bytes(kMaxAnswerBytes);
  v1::SliceResponse response;
  absl::Status status = impl_->retry([&] {
    return impl_->call(
        [&](grpc::ClientContext* context) { return impl_->surfaces->Slice(context, request, &response); });
  });
  if (!status.ok()) return status;
  Slice slice;
  if (response.values().shape_size() != 2 || response.origin_size() != 3 || response.spacing_size() != 2) {
    return absl::InternalError("the server sent a plane without counts, an origin or spacings");
  }
  slice.counts = {response.values().shape(1), response.values().shape(0)};
  status.Update(append_floats(response.values(), slice.counts[0], slice.values));
  status.Update(check_answered(slice.values.size(), slice.counts[0] * slice.counts[1]));
  status.Update(check_answered(response.curves_size(), std::max(request.levels_size(), 1)));
  for (const v1::LevelCurves& curves : response.curves()) {
    status.Update(read_curves(curves, slice.curves.emplace_back()));
  }
  if (response.u_size() != 3 || response.v_size() != 3) {
    status.Update(absl::InternalError("the server sent a plane without two axes of 3 numbers"));
  }
  if (!status.ok()) return status;
  std::copy_n(response.u().begin(), 3, slice.u.begin());
  std::copy_n(response.v().begin(), 3, slice.v.begin());
  std::copy_n(response.origin().begin(), 3, slice.origin.begin());
  std::copy_n(response.spacing().begin(), 2, slice.spacing.begin());
  return slice;
}

}  // namespace isofield
