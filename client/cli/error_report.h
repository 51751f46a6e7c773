#pragma once

#include <absl/status/status.h>

#include "exit_codes.h"

namespace isofield {

// Prints an error in words on the standard error. With `json` it also prints an object for machines on the standard
// output, {"error": {"code": "NOT_FOUND", "message": ..., "exit_code": 1}}. Returns the exit code.
ExitCode report_error(const absl::Status& error, bool json);

}  // namespace isofield
