// The gRPC server, with the threads and the socket beside it.
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

class Server {
 public:
  // Listens on config.listen, and serves. `services` must outlive it. INVALID_ARGUMENT, ALREADY_EXISTS, UNAVAILABLE: it
  // cannot listen there.
  static absl::StatusOr<std::unique_ptr<Server>> start(const Config& config, Services& services);

  // Takes no further calls, and returns when those that run have ended, by themselves or, after `drain`, by force.
  void stop(std::chrono::seconds drain);

 private:
  Server() = default;

  // Destroyed, the server goes after the calls.
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<rpc::EvaluateCalls> evaluate_calls_;
  std::unique_ptr<rpc::EvaluateStreams> evaluate_streams_;
  std::unique_ptr<RegionSocket> region_socket_;  // null: no memory is shared
};

}  // namespace isofield::daemon
