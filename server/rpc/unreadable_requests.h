// Answers requests whose bytes are no message of their method's type with INVALID_ARGUMENT and an explanation. gRPC by
// itself would answer INTERNAL without an explanation.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <string>

namespace isofield::rpc {

// Returns the error for such a request. `type` is the full name of the message that the method expects.
absl::Status unreadable(const std::string& type);

// Parses the request of a method that takes its requests as bytes, and empties `bytes`. INVALID_ARGUMENT: the bytes are
// no such message.
template <class Message>
absl::Status parse_request(grpc::ByteBuffer& bytes, Message& message) {
  if (grpc::SerializationTraits<Message>::Deserialize(&bytes, &message).ok()) return absl::OkStatus();
  return unreadable(Message::descriptor()->full_name());
}

// Returns interceptors for methods whose single request gRPC reads. They replace gRPC's status for an unreadable
// request by unreadable().
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> refuse_unreadable_requests();

}  // namespace isofield::rpc
