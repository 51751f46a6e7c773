#include <cstdio>

#include "daemon/config.h"
#include "daemon/daemon.h"

int main(int argc, char** argv) {
  const isofield::daemon::ParsedConfig parsed = isofield::daemon::parse_config(argc, argv, ISOFIELD_VERSION);
  if (!parsed.config) return parsed.exit_status;
  const absl::Status status = isofield::daemon::run(*parsed.config, ISOFIELD_VERSION);
  if (status.ok()) return 0;
  std::fprintf(stderr, "isofieldd: %s\n", std::string(status.message()).c_str());
  return 1;
}
