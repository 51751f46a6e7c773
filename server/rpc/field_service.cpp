#include "rpc/field_service.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "base/status_macros.h"
#include "engine/mesh/mesh_lattice.h"
#include "rpc/answer_limit.h"
#include "rpc/geometry_arguments.h"
#include "rpc/grid_parts.h"
#include "rpc/result_message.h"
#include "rpc/status.h"
#include "rpc/tensor.h"
#include "rpc/unreadable_requests.h"

namespace isofield::rpc {
namespace {

// Points that are evaluated at once for a grid, whose results are 1 to 4 MiB; more where layers are larger than that. A
// message holds as many where the client takes it.
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

struct FieldService::Evaluation {
  engine::PointBatch batch;
  MessagePoints points;
  std::optional<ResultMessage> result;  // none: into shared memory
};

template <class Request>
absl::StatusOr<engine::PointBatch> FieldService::batch_of(const grpc::ServerContext& context,
                                                          const Request& request) const {
  CallNotes* const notes = log_.notes_of(context);
  if (notes) notes->set_subject(request.scene());
  ISOFIELD_ASSIGN_OR_RETURN(engine::PointBatch batch,
                            read_batch(context, scenes_, request.scene(), request.quantity(), request.priority()));
  if (notes) batch.times = &notes->times();
  return batch;
}

absl::StatusOr<std::shared_ptr<FieldService::Evaluation>> FieldService::read(const grpc::ServerContext& context,
                                                                             grpc::ByteBuffer& incoming,
                                                                             v1::EvaluateRequest& request) const {
  ISOFIELD_RETURN_IF_ERROR(parse_request(incoming, request));
  auto evaluation = std::make_shared<Evaluation>();
  engine::PointBatch& batch = evaluation->batch;
  ISOFIELD_ASSIGN_OR_RETURN(batch, batch_of(context, request));
  ISOFIELD_ASSIGN_OR_RETURN(evaluation->points, read_points(PointFields(request), batch.quantity, limits_, regions_));
  batch.xyz = evaluation->points.points.xyz();
  if (CallNotes* const notes = log_.notes_of(context)) notes->add_work("points", evaluation->points.points.size());
  if (evaluation->points.result) {
    batch.out = evaluation->points.shared_numbers();
    return evaluation;
  }
  const std::uint64_t rows = evaluation->points.points.size(), columns = components(batch.quantity);
  ISOFIELD_RETURN_IF_ERROR(check_number_rows(request.answer_in_numbers(), rows));
  ISOFIELD_RETURN_IF_ERROR(AnswerLimit(request.max_answer_bytes())
                               .admit(ResultMessage::bytes(rows, columns, request.answer_in_numbers()),
                                      "send the points by EvaluateStream, which answers any number of them"));
  evaluation->result.emplace(rows, columns);
  batch.out = evaluation->result->numbers();
  return evaluation;
}

void FieldService::evaluate(grpc::ServerContext& context, grpc::ByteBuffer& incoming, v1::EvaluateRequest& request,
                            Answer done) {
  const auto evaluation = read(context, incoming, request);
  if (!evaluation.ok()) return done(to_grpc(evaluation.status()), grpc::ByteBuffer());
  engine_.submit(std::move((*evaluation)->batch), [&context, &request, evaluation = *evaluation,
                                                   done = std::move(done)](const absl::Status& status) {
    if (const auto ms = engine::retry_after_ms(status)) {
      context.AddTrailingMetadata("grpc-retry-pushback-ms", absl::StrCat(*ms));
    }
    if (!status.ok()) return done(to_grpc(status), grpc::ByteBuffer());
    if (!evaluation->result) return done(grpc::Status::OK, empty_result());
    done(grpc::Status::OK, evaluation->result->take(request.answer_in_numbers()));
  });
}

absl::StatusOr<engine::PointBatch> FieldService::begin(const grpc::ServerContext& context,
                                                       const v1::EvaluateStreamRequest& first) const {
  return batch_of(context, first);
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
  const absl::StatusOr<scenes::LeasedScene> leased = scenes_.lease(request->scene());
  if (!leased.ok()) return to_grpc(leased.status());

  const absl::StatusOr<AnswerLimit> limit = AnswerLimit::of_stream(request->max_answer_bytes());
  if (!limit.ok()) return to_grpc(limit.status());

  const auto [nx, ny, nz] = lattice->cells;
  const std::uint64_t layer = std::uint64_t{nx} * ny;
  const std::uint32_t width = engine::components(*quantity);
  // Points of a message.
  const std::uint64_t most = std::min(limit->rows(width * sizeof(float)), limits_.max_points_per_message);
  const auto cancelled = [&] { return context->IsCancelled(); };
  // Whole layers of bricks are evaluated at once, at least one.
  const std::uint64_t bricks = std::max<std::uint64_t>(std::min(most, kGridSlab) / layer / blobtree::kBrickCells, 1);
  const auto step = static_cast<std::uint32_t>(std::min<std::uint64_t>(bricks * blobtree::kBrickCells, nz + 3));
  v1::EvaluateGridResponse response;
  std::vector<float> several;  // layers that take more than one message
  for (std::uint32_t k = 0; k < nz; k += step) {
    if (cancelled()) return to_grpc(client_gone());
    const std::uint32_t layers = std::min(step, nz - k);
    if (layers * layer <= most) {
      response.Clear();
      response.set_first_layer(k);
      const absl::Status s =
          engine_.fields().evaluate_layers(*leased->scene, *lattice, k, *quantity,
                                           make_float_tensor({layers, ny, nx, width}, *response.mutable_result()),
                                           cancelled);
      if (!s.ok()) return to_grpc(s);
      if (!writer->Write(response)) return to_grpc(client_gone());
      continue;
    }
    several.resize(layers * layer * width);
    const absl::Status s =
        engine_.fields().evaluate_layers(*leased->scene, *lattice, k, *quantity, std::span(several), cancelled);
    if (!s.ok()) return to_grpc(s);
    std::uint64_t written = 0;
    for (const GridPart& part : grid_parts({nx, ny, layers}, most)) {
      response.Clear();
      response.set_first_layer(k + part.first[2]);
      response.set_first_row(part.first[1]);
      response.set_first_column(part.first[0]);
      const auto [columns, rows, whole] = part.counts;
      const std::span<float> out = make_float_tensor({whole, rows, columns, width}, *response.mutable_result());
      std::copy_n(several.begin() + written, out.size(), out.begin());
      written += out.size();
      if (!writer->Write(response)) return to_grpc(client_gone());
    }
  }
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
