// Runs the daemon: it starts all parts in order, serves, and on a signal drains and shuts down.
#pragma once

#include <absl/status/status.h>

#include "daemon/config.h"

namespace isofield::daemon {

// Serves until SIGTERM or SIGINT comes, then gives running requests config.drain_seconds to finish; a second signal
// ends the process at once. It must be called before other threads start, since it blocks these signals for all
// threads. Returns an error if the daemon cannot start.
absl::Status run(const Config& config, const std::string& version);

}  // namespace isofield::daemon
