// Answers INVALID_ARGUMENT with an explanation to requests whose bytes are no message of their method's type. gRPC by
// itself would answer INTERNAL without an explanation.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <string>

namespace isofield::rpc {

// The error for such a request. `type` is the full name of the message that the method expects.
absl::Status unreadable(const std::string& type);

// Parses the request of a method that takes its requests as bytes. Empties `bytes`.
template <class Message>
absl::Status parse_request(grpc::ByteBuffer& bytes, Message& message) {
  if (grpc::SerializationTraits<Message>::Deserialize(&bytes, &message).ok()) return absl::OkStatus();
  return unreadable(Message::descriptor()->full_name());
}

// Interceptors for methods whose single request gRPC reads. They replace its answer to an unreadable request by that of
// unreadable().
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> refuse_unreadable_requests();

}  // namespace isofield::rpc
