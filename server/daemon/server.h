// Starts and stops the gRPC server, with the threads that serve Evaluate and EvaluateStream and the socket for shared
// memory.
#pragma once

#include <absl/status/statusor.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>

#include "daemon/config.h"
#include "daemon/region_socket.h"
#include "daemon/services.h"
#include "rpc/evaluate_calls.h"
#include "rpc/evaluate_streams.h"

namespace isofield::daemon {

// Owns the gRPC server and what serves beside it. One thread starts and stops it.
class Server {
 public:
  // Listens on config.listen, and serves. `services` must outlive it. INVALID_ARGUMENT: the address is malformed.
  // ALREADY_EXISTS: another process serves there. UNAVAILABLE: it cannot listen there for another reason.
  static absl::StatusOr<std::unique_ptr<Server>> start(const Config& config, Services& services);

  // Takes no further calls, and returns when all running ones have ended. Those that still run after `drain` are
  // cancelled.
  void stop(std::chrono::seconds drain);

 private:
  Server() = default;

  // Members are destroyed from the last to the first, so the server is destroyed after the calls.
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<rpc::EvaluateCalls> evaluate_calls_;
  std::unique_ptr<rpc::EvaluateStreams> evaluate_streams_;
  std::unique_ptr<RegionSocket> region_socket_;  // null if no memory is shared
};

}  // namespace isofield::daemon
