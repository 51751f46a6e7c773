#pragma once

#include <absl/status/status.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>
#include <string>

namespace isofield {

// What a request's outcome means to its caller: the server's own words, or, where the transport speaks, what happened
// and what to do. `address` is the one that the user gave.
absl::Status from_grpc(const grpc::Status& status, const std::string& address);

// When a call that has failed may be tried again: the trailing metadata grpc-retry-pushback-ms, a number >= 0.
std::optional<std::chrono::milliseconds> retry_after(const grpc::ClientContext& context);

}  // namespace isofield
