// Checks the address on which the daemon is to listen, in ways in which gRPC does not check it.
#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield::daemon {

// INVALID_ARGUMENT: the address is neither HOST:PORT nor unix:PATH; gRPC would choose port 443 if none is stated, and
// some other port for one beyond 65535. ALREADY_EXISTS: another process serves on the unix socket; gRPC would take over
// its path.
absl::Status check_listen_address(const std::string& address);

// Returns the path of an address unix:PATH, or "" for another address.
std::string unix_path(const std::string& address);

}  // namespace isofield::daemon
