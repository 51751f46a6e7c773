// Turns the outcomes of gRPC calls into the errors that the client library returns.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>
#include <string>

namespace isofield {

// Returns the outcome of a request as its caller sees it. A message of the server stays as it is; where the transport
// failed, the message says what happened and what to do. `address` is the one that the user gave.
absl::Status from_grpc(const grpc::Status& status, const std::string& address);

// Returns how long to wait before a call that has failed is tried again, which the server states in the trailing
// metadata grpc-retry-pushback-ms as a number >= 0. Returns nothing where it states none.
std::optional<std::chrono::milliseconds> retry_after(const grpc::ClientContext& context);

}  // namespace isofield
