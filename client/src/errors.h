#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/status.h>

#include <string>

namespace isofield {

// What a request's outcome means to its caller: the server's own words, or, where the transport speaks, what happened
// and what to do. `address` is the one that the user gave.
absl::Status from_grpc(const grpc::Status& status, const std::string& address);

}  // namespace isofield
