#pragma once

#include <absl/status/statusor.h>

#include <string>

namespace isofield {

// The gRPC target of an address "HOST:PORT", "[IPV6]:PORT" or "unix:PATH".
// INVALID_ARGUMENT: none of these; the message names the forms.
absl::StatusOr<std::string> grpc_target(const std::string& address);

// True where a machine is at HOST:PORT or [IPV6]:PORT and refuses connections there, for nothing listens. Asks it, and
// takes up to half a second for each of the host's addresses.
bool is_refused(const std::string& address);

}  // namespace isofield
