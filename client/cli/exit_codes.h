#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield {

// The exit codes of the command line. They are part of its contract, and `isofield --help` lists them.
enum ExitCode : int {
  kSuccess = 0,
  kRequestFailed = 1,  // the server refused the request, or failed
  kWrongUsage = 2,
  kNoServer = 3,    // no server answers, or the connection was lost
  kFileFailed = 4,  // a file cannot be read, understood or written
};

// These functions mark an error as a fault of a file or of the command line; usage_error() makes an INVALID_ARGUMENT.
// Any other error counts as one of the server or of the connection to it.
absl::Status file_error(absl::Status status);
absl::Status usage_error(const std::string& message);

// Returns the exit code for a status. An UNAVAILABLE error without a mark is kNoServer, any other one without a mark
// kRequestFailed.
ExitCode exit_code(const absl::Status& status);

}  // namespace isofield
