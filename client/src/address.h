// Addresses of servers, as users write them.
#pragma once

#include <absl/status/statusor.h>

#include <string>

namespace isofield {

// Returns the gRPC target of an address "HOST:PORT", "[IPV6]:PORT" or "unix:PATH". INVALID_ARGUMENT: the address is
// none of these; the message names the forms.
absl::StatusOr<std::string> grpc_target(const std::string& address);

// Returns true where a machine is at HOST:PORT or [IPV6]:PORT and refuses connections, because nothing listens there.
// It tries to connect, which takes up to half a second for each network address of the host.
bool is_refused(const std::string& address);

}  // namespace isofield
