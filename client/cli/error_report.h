#pragma once

#include <absl/status/status.h>

#include "exit_codes.h"

namespace isofield {

// Prints an error: words for people to the standard error, and with `json` besides an object for machines to the
// standard output, {"error": {"code": "NOT_FOUND", "message": ..., "exit_code": 1}}. Returns the exit code.
ExitCode report_error(const absl::Status& error, bool json);

}  // namespace isofield
