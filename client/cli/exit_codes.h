#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield {

// What the command ends with. Part of the command line's contract; `isofield --help` lists them.
enum ExitCode : int {
  kSuccess = 0,
  kRequestFailed = 1,  // the server refused the request, or failed
  kWrongUsage = 2,
  kNoServer = 3,    // no server answers, or the connection was lost
  kFileFailed = 4,  // a file cannot be read, understood or written
};

// Marks an error as a file's, or as the command line's; others are the server's.
absl::Status file_error(absl::Status status);
absl::Status usage_error(const std::string& message);

ExitCode exit_code(const absl::Status& status);

}  // namespace isofield
