// Checks of a listening address that gRPC leaves out.
#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield::daemon {

// gRPC takes over a unix socket's path even from a process that serves on it. ALREADY_EXISTS when one does.
absl::Status check_unix_socket_free(const std::string& address);

}  // namespace isofield::daemon
