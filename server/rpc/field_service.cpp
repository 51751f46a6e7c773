#include "rpc/field_service.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "engine/mesh_lattice.h"
#include "engine/status_macros.h"
#include "rpc/geometry_arguments.h"
#include "rpc/status.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

// Points of one message of a grid's answer: 1 to 4 MiB.
constexpr std::uint64_t kGridSlab = 1u << 18;

absl::StatusOr<blobtree::Lattice> read_lattice(const v1::EvaluateGridRequest& request, const Limits& limits) {
  blobtree::Lattice lattice;
  ISOFIELD_ASSIGN_OR_RETURN(lattice.origin, read_vector("origin", request.origin()));
  google::protobuf::RepeatedField<double> spacing = request.spacing();
  if (spacing.size() == 1) {
    const double same = spacing[0];
    spacing.Resize(3, same);
  }
  ISOFIELD_ASSIGN_OR_RETURN(lattice.spacing, read_vector("spacing", spacing));
  for (int i = 0; i < 3; ++i) {
    if (!(spacing[i] > 0)) {
      return absl::InvalidArgumentError(absl::StrCat("spacing[", i, "] = ", spacing[i], ": expected a number > 0"));
    }
  }
  if (request.counts_size() != 3) {
    return absl::InvalidArgumentError(absl::StrCat("counts holds ", request.counts_size(), " numbers: expected 3"));
  }
  unsigned __int128 points = 1;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t count = request.counts(i);
    if (count < 1 || count > engine::kMaxCellsPerAxis) {
      return absl::InvalidArgumentError(
          absl::StrCat("counts[", i, "] = ", count, ": expected a count within [1, ", engine::kMaxCellsPerAxis, "]"));
    }
    lattice.cells[i] = static_cast<std::uint32_t>(count);
    points *= count;
  }
  if (points > limits.max_grid_points) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the grid has more points than the ", limits.max_grid_points, " admitted"));
  }
  const std::uint64_t layer = std::uint64_t{lattice.cells[0]} * lattice.cells[1];
  if (layer > limits.max_points_per_message) {
    return absl::ResourceExhaustedError(absl::StrCat("a layer of the grid has ", layer, " points, at most ",
                                                     limits.max_points_per_message,
                                                     " are admitted: ask for parts of it"));
  }
  return lattice;
}

}  // namespace

void FieldService::evaluate(grpc::ServerContext& context, const v1::EvaluateRequest& request,
                            v1::EvaluateResponse& response, std::function<void(const grpc::Status&)> done) {
  absl::StatusOr<engine::PointBatch> batch =
      read_batch(context, scenes_, request.scene(), request.quantity(), request.priority());
  if (!batch.ok()) return done(to_grpc(batch.status()));
  absl::StatusOr<MessagePoints> read = read_points(PointFields(request), batch->quantity, limits_, regions_);
  if (!read.ok()) return done(to_grpc(read.status()));
  const auto message = std::make_shared<const MessagePoints>(*std::move(read));
  batch->xyz = message->points.xyz();
  batch->out = message->result ? message->shared_numbers()
                               : make_float_tensor({message->points.size(), components(batch->quantity)},
                                                   *response.mutable_result());
  engine_.submit(*std::move(batch), [&context, message, done = std::move(done)](const absl::Status& status) {
    if (const auto ms = engine::retry_after_ms(status)) {
      context.AddTrailingMetadata("grpc-retry-pushback-ms", absl::StrCat(*ms));
    }
    done(to_grpc(status));
  });
}

absl::StatusOr<engine::PointBatch> FieldService::begin(const grpc::ServerContext& context,
                                                       const v1::EvaluateStreamRequest& first) const {
  return read_batch(context, scenes_, first.scene(), first.quantity(), first.priority());
}

absl::StatusOr<MessagePoints> FieldService::points_of(const v1::EvaluateStreamRequest& request,
                                                      engine::Quantity quantity) const {
  return read_points(PointFields(request), quantity, limits_, regions_);
}

grpc::Status FieldService::EvaluateGrid(grpc::ServerContext* context, const v1::EvaluateGridRequest* request,
                                        grpc::ServerWriter<v1::EvaluateGridResponse>* writer) {
  const absl::StatusOr<engine::Quantity> quantity = read_quantity(request->quantity());
  if (!quantity.ok()) return to_grpc(quantity.status());
  const absl::StatusOr<blobtree::Lattice> lattice = read_lattice(*request, limits_);
  if (!lattice.ok()) return to_grpc(lattice.status());
  const absl::StatusOr<LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());

  const auto [nx, ny, nz] = lattice->cells;
  const std::uint64_t layer = std::uint64_t{nx} * ny;
  // Whole layers of bricks are evaluated at once, at least one; of large layers a message holds fewer.
  const std::uint64_t bricks = std::max<std::uint64_t>(kGridSlab / layer / blobtree::kBrickCells, 1);
  const auto step = static_cast<std::uint32_t>(std::min<std::uint64_t>(bricks * blobtree::kBrickCells, nz + 3));
  const std::uint64_t most = limits_.max_points_per_message / layer;
  const std::uint32_t width = engine::components(*quantity);
  v1::EvaluateGridResponse response;
  std::vector<float> several;  // layers that take more than one message
  for (std::uint32_t k = 0; k < nz; k += step) {
    if (context->IsCancelled()) return {grpc::StatusCode::CANCELLED, "the client is gone"};
    const std::uint32_t layers = std::min(step, nz - k);
    for (std::uint64_t at = 0; at < layers; at += most) {
      const std::uint64_t part = std::min<std::uint64_t>(most, layers - at);
      response.Clear();
      response.set_first_layer(k + at);
      const std::span<float> out = make_float_tensor({part, ny, nx, width}, *response.mutable_result());
      if (at == 0) {
        if (part < layers) several.resize(layers * layer * width);
        const absl::Status s = engine_.fields().evaluate_layers(*leased->scene, *lattice, k, *quantity,
                                                                part < layers ? std::span(several) : out,
                                                                [&] { return context->IsCancelled(); });
        if (!s.ok()) return to_grpc(s);
      }
      if (part < layers) std::copy_n(several.begin() + at * layer * width, out.size(), out.begin());
      if (!writer->Write(response)) return {grpc::StatusCode::CANCELLED, "the client is gone"};
    }
  }
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
