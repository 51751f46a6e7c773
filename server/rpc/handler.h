// Turns handlers of methods into functions that gRPC calls: each request must first be admitted, an exception becomes
// an error, and the handler's status becomes a status of gRPC. Calls that are not served by serve(), such as Evaluate
// and TrackMesh, use finish() and base::guarded() themselves.
//
// A handler is a function that returns absl::Status. It decodes a request, asks its Call for room for the work, calls
// down, and encodes the answer.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/support/sync_stream.h>

#include <functional>
#include <utility>

#include "base/guarded.h"
#include "base/status_macros.h"
#include "rpc/admission.h"
#include "rpc/answer_limit.h"
#include "rpc/status.h"
#include "rpc/tensor.h"

namespace isofield::rpc {

// One call as its handler sees it. `context` must outlive it, and must outlive the functions that cancelled() returns.
class Call {
 public:
  Call(const grpc::ServerContext& context, Admission::Ticket ticket) : context_(context), ticket_(std::move(ticket)) {}

  // Asks for room for the estimated work of the request. RESOURCE_EXHAUSTED: there is none now.
  absl::Status admit(std::uint64_t points) { return ticket_.add(points); }
  // Returns a function that tells whether the client has gone or given up.
  std::function<bool()> cancelled() const {
    return [&context = context_] { return context.IsCancelled(); };
  }

 private:
  const grpc::ServerContext& context_;
  Admission::Ticket ticket_;
};

// Returns the status with which a call ends. After a refusal by admission it also puts into the trailing metadata when
// the client may try again.
grpc::Status finish(grpc::ServerContext& context, const absl::Status& status);

// Serves a call by handle(Call&), or refuses it if `admission` has no place.
template <class Handle>
grpc::Status serve(grpc::ServerContext& context, Admission& admission, const Handle& handle) {
  return finish(context, base::guarded([&]() -> absl::Status {
                  ISOFIELD_ASSIGN_OR_RETURN(Admission::Ticket ticket, admission.admit());
                  Call call(context, std::move(ticket));
                  return handle(call);
                }));
}

// Does the same for a request that states how large its answer may be, and perhaps that arrays must be plain numbers.
// `instead` says what the client can do if the answer is too large.
template <class Request, class Response, class Handle>
grpc::Status serve_limited(grpc::ServerContext& context, Admission& admission, const Request& request,
                           Response& response, absl::string_view instead, const Handle& handle) {
  return serve(context, admission, [&](Call& call) -> absl::Status {
    ISOFIELD_RETURN_IF_ERROR(handle(call));
    if constexpr (requires { request.answer_in_numbers(); }) {
      if (request.answer_in_numbers()) write_tensors_as_numbers(response);
    }
    return AnswerLimit(request.max_answer_bytes()).admit(response.ByteSizeLong(), instead);
  });
}

// Writes a message of a streamed answer. CANCELLED: the client is gone.
template <class Response>
absl::Status send(grpc::ServerWriter<Response>& writer, const Response& response) {
  return writer.Write(response) ? absl::OkStatus() : client_gone();
}

}  // namespace isofield::rpc
