// Start-up order, serving, drain and shutdown.
#pragma once

#include <absl/status/status.h>

#include "daemon/config.h"

namespace isofield::daemon {

// Serves until SIGTERM or SIGINT, then lets running requests finish for config.drain_seconds; a second signal ends the
// process at once. Call it from main before other threads start: it blocks those signals for all of them.
absl::Status run(const Config& config, const std::string& version);

}  // namespace isofield::daemon
