#include "commands/context.h"

#include <chrono>

#include "exit_codes.h"

namespace isofield {

absl::StatusOr<Client> Context::connect(bool shared_memory) const {
  ClientOptions options;
  options.shared_memory = shared_memory;
  if (timeout > 0) {
    options.unary_timeout = std::chrono::milliseconds(static_cast<long long>(timeout * 1000) + 1);
    options.stream_timeout = options.unary_timeout;
  }
  auto client = Client::connect(server, options);
  if (!client.ok()) return usage_error(std::string(client.status().message()));
  return client;
}

}  // namespace isofield
