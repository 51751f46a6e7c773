#include "rpc/field_service.h"

#include <algorithm>
#include <optional>

#include "base/guarded.h"
#include "base/status_macros.h"
#include "rpc/answer_limit.h"
#include "rpc/evaluate_grid.h"
#include "rpc/result_message.h"
#include "rpc/unreadable_requests.h"

namespace isofield::rpc {

struct FieldService::Evaluation {
  engine::PointBatch batch;
  MessagePoints points;
  std::optional<ResultMessage> result;  // absent if results go into shared memory
  Admission::Ticket ticket;
};

template <class Request>
absl::StatusOr<engine::PointBatch> FieldService::batch_of(const grpc::ServerContext& context,
                                                          const Request& request) const {
  CallNotes* const notes = log_.notes_of(context);
  if (notes) notes->set_scene(request.scene());
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
  ISOFIELD_ASSIGN_OR_RETURN(evaluation->points, read_points(PointFields(request), batch.layout, limits_, regions_));
  const std::uint64_t rows = evaluation->points.points.size();
  batch.xyz = evaluation->points.points.xyz();
  if (CallNotes* const notes = log_.notes_of(context)) notes->add_work("points", rows);
  if (!evaluation->points.result) {
    ISOFIELD_RETURN_IF_ERROR(check_number_rows(request.answer_in_numbers(), rows));
    ISOFIELD_RETURN_IF_ERROR(AnswerLimit(request.max_answer_bytes())
                                 .admit(ResultMessage::bytes(rows, batch.layout, request.answer_in_numbers()),
                                        "send the points by EvaluateStream, which answers any number of them"));
  }
  if (rows > 0) {
    ISOFIELD_ASSIGN_OR_RETURN(evaluation->ticket, batches_.admit(rows));
  }
  if (evaluation->points.result) {
    batch.out = evaluation->points.shared_numbers();
  } else {
    evaluation->result.emplace(rows, batch.layout);
    batch.out = evaluation->result->numbers();
  }
  return evaluation;
}

void FieldService::evaluate(const grpc::ServerContext& context, grpc::ByteBuffer& incoming,
                            v1::EvaluateRequest& request, Answer done) {
  const auto evaluation = base::guarded([&] { return read(context, incoming, request); });
  if (!evaluation.ok()) return done(evaluation.status(), grpc::ByteBuffer());
  engine_.submit(std::move((*evaluation)->batch),
                 [&request, evaluation = *evaluation, done = std::move(done)](const absl::Status& status) {
                   // The place is given up before the answer is sent, so that the client's next request finds room.
                   evaluation->ticket = {};
                   if (!status.ok()) return done(status, grpc::ByteBuffer());
                   if (!evaluation->result) return done(status, empty_result());
                   done(status, evaluation->result->take(request.answer_in_numbers()));
                 });
}

absl::StatusOr<engine::PointBatch> FieldService::begin(const grpc::ServerContext& context,
                                                       const v1::EvaluateStreamRequest& first) const {
  return batch_of(context, first);
}

absl::StatusOr<MessagePoints> FieldService::points_of(const v1::EvaluateStreamRequest& request,
                                                      const engine::ResultLayout& layout) const {
  return read_points(PointFields(request), layout, limits_, regions_);
}

absl::Status FieldService::evaluate_grid(Call& call, const v1::EvaluateGridRequest& request,
                                         grpc::ServerWriter<v1::EvaluateGridResponse>& writer) {
  ISOFIELD_ASSIGN_OR_RETURN(const engine::ResultLayout layout, read_layout(request.quantity()));
  ISOFIELD_ASSIGN_OR_RETURN(const blobtree::Lattice lattice, read_lattice(request, limits_));
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::LeasedScene leased, scenes_.lease(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(const AnswerLimit limit, AnswerLimit::of_stream(request.max_answer_bytes()));
  ISOFIELD_RETURN_IF_ERROR(call.admit(points_of_lattice(lattice)));
  const std::uint64_t most = std::min(limit.rows(layout.bytes()), limits_.max_points_per_message);
  return GridEvaluation(engine_.fields(), *leased.scene, lattice, layout, most, call, writer).run();
}

}  // namespace isofield::rpc
