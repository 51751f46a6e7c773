// Turns absl's statuses into gRPC's.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/status.h>

namespace isofield::rpc {

// The most bytes of a status message. gRPC's clients accept 8 KiB of headers in all, and gRPC may encode one byte as
// three.
inline constexpr std::size_t kMaxStatusBytes = 2048;

// Converts a status. Both libraries use the same numbers for codes by design. The message is cut at kMaxStatusBytes,
// and control characters in it are escaped.
grpc::Status to_grpc(const absl::Status& status);

// Returns the status CANCELLED, for a client that no longer waits for its answer.
absl::Status client_gone();

}  // namespace isofield::rpc
