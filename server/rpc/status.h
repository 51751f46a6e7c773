// Translates absl's statuses to gRPC's.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/status.h>

namespace isofield::rpc {

// The most bytes of a status's message. gRPC's clients accept 8 KiB of headers in all, and gRPC may encode a byte as
// three.
inline constexpr std::size_t kMaxStatusBytes = 2048;

// The codes are the same numbers by design. The message is cut at kMaxStatusBytes, and control characters in it are
// escaped.
grpc::Status to_grpc(const absl::Status& status);

// CANCELLED: nobody is there to take an answer.
absl::Status client_gone();

}  // namespace isofield::rpc
