// Checks of a listening address that gRPC leaves out.
#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield::daemon {

// INVALID_ARGUMENT: neither HOST:PORT nor unix:PATH; gRPC would choose port 443 where none is stated, and another one
// for a port beyond 65535. ALREADY_EXISTS: another process serves on the unix socket; gRPC would take its path over.
absl::Status check_listen_address(const std::string& address);

// The path of unix:PATH; empty: another address.
std::string unix_path(const std::string& address);

}  // namespace isofield::daemon
