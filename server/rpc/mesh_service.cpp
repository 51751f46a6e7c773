#include "rpc/mesh_service.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <chrono>

#include "engine/mesh_lattice.h"
#include "engine/mesh_measure.h"
#include "engine/status_macros.h"
#include "rpc/geometry_arguments.h"
#include "rpc/status.h"

namespace isofield::rpc {
namespace {

using Clock = std::chrono::steady_clock;
using Writer = grpc::ServerWriter<v1::MeshResponse>;

constexpr std::size_t kPartBytes = 1u << 20;
constexpr auto kProgressEvery = std::chrono::milliseconds(100);
constexpr std::uint32_t kMaxResolution = 1u << 20;

absl::StatusOr<double> read_cell_size(const v1::MeshRequest& request, const engine::MeshRequest& so_far,
                                      const blobtree::Tape& tape) {
  switch (request.cells_case()) {
    case v1::MeshRequest::kCellSize:
      return read_length("cell_size", request.cell_size());
    case v1::MeshRequest::kResolution: {
      if (request.resolution() < 1 || request.resolution() > kMaxResolution) {
        return absl::InvalidArgumentError(
            absl::StrCat("resolution = ", request.resolution(), ": expected a count within [1, ", kMaxResolution, "]"));
      }
      const blobtree::Box box = so_far.bounds.value_or(tape.support);
      if (box.empty()) return 1.0;
      return std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z}) / request.resolution();
    }
    default:
      return engine::automatic_cell_size(tape, so_far);
  }
}

absl::StatusOr<engine::MeshRequest> read_request(const v1::MeshRequest& request, const blobtree::Tape& tape,
                                                 const Limits& limits) {
  engine::MeshRequest r;
  ISOFIELD_ASSIGN_OR_RETURN(r.bounds, read_bounds(request.bounds_min(), request.bounds_max()));
  ISOFIELD_ASSIGN_OR_RETURN(r.iso, read_iso(request, tape.law));
  ISOFIELD_RETURN_IF_ERROR(check_bounded(tape, r.bounds, r.iso));
  r.with_normals = !request.omit_normals();
  r.max_cells = limits.max_mesh_cells;
  ISOFIELD_ASSIGN_OR_RETURN(r.cell_size, read_cell_size(request, r, tape));
  return r;
}

template <class T>
void fill(v1::Tensor& tensor, v1::Tensor::DType dtype, std::span<const T> rows) {
  tensor.set_dtype(dtype);
  tensor.add_shape(rows.size() / 3);
  tensor.add_shape(3);
  tensor.set_data(rows.data(), rows.size_bytes());
}

// Writes an array of rows of 3 in parts. False: the client is gone.
template <class T>
bool write_rows(Writer& writer, const std::vector<T>& rows, v1::Tensor::DType dtype,
                v1::Tensor* (v1::MeshPart::*field)()) {
  constexpr std::size_t kRows = kPartBytes / (3 * sizeof(T)) * 3;
  for (std::size_t at = 0; at < rows.size(); at += kRows) {
    v1::MeshResponse response;
    fill(*(response.mutable_part()->*field)(), dtype, std::span(rows).subspan(at, std::min(kRows, rows.size() - at)));
    if (!writer.Write(response)) return false;
  }
  return true;
}

void fill_summary(const engine::Mesh& mesh, const engine::MeshRequest& request, std::uint64_t scene_version,
                  Clock::time_point start, v1::MeshSummary& summary) {
  summary.set_vertices(mesh.positions.size() / 3);
  summary.set_triangles(mesh.triangles.size() / 3);
  summary.set_cell_size(request.cell_size);
  summary.set_cells(mesh.cells);
  summary.set_seconds(std::chrono::duration<double>(Clock::now() - start).count());
  summary.set_scene_version(scene_version);
}

}  // namespace

grpc::Status MeshService::Mesh(grpc::ServerContext* context, const v1::MeshRequest* request, Writer* writer) {
  const Clock::time_point start = Clock::now();
  const absl::StatusOr<LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());
  const absl::StatusOr<engine::MeshRequest> r = read_request(*request, leased->scene->tape(), limits_);
  if (!r.ok()) return to_grpc(r.status());

  Clock::time_point last = start;
  const engine::MeshCallbacks callbacks{
      .progress =
          [&](double fraction) {
            const Clock::time_point now = Clock::now();
            if (now - last < kProgressEvery) return;
            last = now;
            v1::MeshResponse response;
            response.mutable_progress()->set_fraction(fraction);
            writer->Write(response);
          },
      .cancelled = [&] { return context->IsCancelled(); },
  };
  const absl::StatusOr<engine::Mesh> mesh = engine_.mesher().mesh(*leased->scene, *r, callbacks);
  if (!mesh.ok()) return to_grpc(mesh.status());

  v1::MeshResponse response;
  fill_summary(*mesh, *r, leased->version, start, *response.mutable_summary());
  if (writer->Write(response) &&
      write_rows(*writer, mesh->positions, v1::Tensor::FLOAT32, &v1::MeshPart::mutable_positions) &&
      write_rows(*writer, mesh->normals, v1::Tensor::FLOAT32, &v1::MeshPart::mutable_normals) &&
      write_rows(*writer, mesh->triangles, v1::Tensor::UINT32, &v1::MeshPart::mutable_triangles)) {
    return grpc::Status::OK;
  }
  return {grpc::StatusCode::CANCELLED, "the client is gone"};
}

grpc::Status MeshService::Measure(grpc::ServerContext* context, const v1::MeshRequest* request,
                                  v1::MeasureResponse* response) {
  const Clock::time_point start = Clock::now();
  const absl::StatusOr<LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());
  absl::StatusOr<engine::MeshRequest> r = read_request(*request, leased->scene->tape(), limits_);
  if (!r.ok()) return to_grpc(r.status());
  r->with_normals = false;
  const engine::MeshCallbacks callbacks{.cancelled = [&] { return context->IsCancelled(); }};
  const absl::StatusOr<engine::Mesh> mesh = engine_.mesher().mesh(*leased->scene, *r, callbacks);
  if (!mesh.ok()) return to_grpc(mesh.status());

  const engine::MeshMeasures measures = engine::measure(*mesh);
  response->set_area(measures.area);
  response->set_volume(measures.volume);
  if (measures.volume > 0) set_vector(measures.centroid, *response->mutable_centroid());
  if (!measures.bounds.empty()) {
    set_vector(measures.bounds.min, *response->mutable_bounds_min());
    set_vector(measures.bounds.max, *response->mutable_bounds_max());
  }
  fill_summary(*mesh, *r, leased->version, start, *response->mutable_summary());
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
