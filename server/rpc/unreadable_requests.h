// Requests whose bytes are no message of the type that their method takes: INVALID_ARGUMENT, with a word on why. gRPC
// by itself answers INTERNAL without one.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <string>

namespace isofield::rpc {

// `type`: the full name of the message that was expected.
absl::Status unreadable(const std::string& type);

// For methods that take their requests as bytes. Empties `bytes`.
template <class Message>
absl::Status parse_request(grpc::ByteBuffer& bytes, Message& message) {
  if (grpc::SerializationTraits<Message>::Deserialize(&bytes, &message).ok()) return absl::OkStatus();
  return unreadable(Message::descriptor()->full_name());
}

// For methods whose one request gRPC reads: turns its answer to an unreadable one into that of unreadable().
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> refuse_unreadable_requests();

}  // namespace isofield::rpc
