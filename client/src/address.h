#pragma once

#include <absl/status/statusor.h>

#include <string>

namespace isofield {

// The gRPC target of an address "HOST:PORT", "[IPV6]:PORT" or "unix:PATH".
// INVALID_ARGUMENT: none of these; the message names the forms.
absl::StatusOr<std::string> grpc_target(const std::string& address);

}  // namespace isofield
