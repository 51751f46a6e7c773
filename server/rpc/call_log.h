// A line of the log for each call: what was asked, how long it waited, and how it ended.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/server_interceptor.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "engine/request_times.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {

// What is known of a call while it runs. Thread-safe.
class CallNotes {
 public:
  engine::RequestTimes& times() { return times_; }

  // The scene, or operator, that is asked about.
  void set_subject(const v1::SceneRef& scene);
  void set_subject(std::string name);
  // "points", "rays", "cells" ...; more of the same unit are added.
  void add_work(const char* unit, std::uint64_t count);

  // " scene=ball points=64", as far as it is known.
  std::string text() const;

 private:
  engine::RequestTimes times_;
  mutable std::mutex mutex_;
  std::string subject_;
  std::map<std::string, std::uint64_t> work_;
};

// Thread-safe. Off, it costs nothing: gRPC is given no interceptor.
class CallLog {
 public:
  using Sink = std::function<void(const std::string& line)>;

  // No sink: off.
  explicit CallLog(Sink sink = {}) : sink_(std::move(sink)) {}
  bool is_on() const { return static_cast<bool>(sink_); }

  // Of a running call; null where the log is off.
  CallNotes* notes_of(const grpc::ServerContextBase& context) const;

  // For grpc::ServerBuilder; must not outlive this. Writes
  //   call 17 MeshService/Mesh scene=neuron cells=263680: queue 0.1 ms, kernels 0.0 ms, device 95.3 ms, transfer 12.0 ms,
  //   total 120.5 ms, OK
  // as one line when a call of isofield's services is over. `queue` is what its work waited for its turn at the device,
  // `kernels` what it waited for the driver to compile, `device` what the device took, and `transfer` what answers took
  // until the transport had them.
  std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> interceptors();

 private:
  class Call;
  class Calls;

  const Sink sink_;
  std::atomic<std::uint64_t> last_id_ = 0;
  mutable std::mutex mutex_;
  std::map<const grpc::ServerContextBase*, CallNotes*> running_;
};

}  // namespace isofield::rpc
