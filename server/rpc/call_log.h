// Writes a line to the log for each call: what the client asked for, how long the call waited, and how it ended.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/server_interceptor.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/mutex.h"
#include "engine/request_times.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {

// The notes that are taken while a call runs, for its line in the log. Thread-safe.
class CallNotes {
 public:
  engine::RequestTimes& times() { return times_; }

  // Sets the scene that the call is about.
  void set_scene(const v1::SceneRef& scene);
  void set_scene(const std::string& name) { set_subject("scene", name); }
  // Sets the operator that the call is about.
  void set_operator(const std::string& name) { set_subject("operator", name); }
  // Adds `count` to the work in a unit, which is "points", "rays" or "cells".
  void add_work(const char* unit, std::uint64_t count);

  // Returns the notes in the form " scene=ball points=64" or " operator=fold points=64".
  std::string text() const;

 private:
  void set_subject(const char* what, std::string name);

  engine::RequestTimes times_;
  mutable base::Mutex mutex_;
  std::string subject_ ABSL_GUARDED_BY(mutex_);  // in the form "scene=ball"
  std::map<std::string, std::uint64_t> work_ ABSL_GUARDED_BY(mutex_);
};

// Takes notes of running calls and writes their lines. Thread-safe. It costs nothing when it is off, since gRPC then
// gets no interceptor.
class CallLog {
 public:
  using Sink = std::function<void(const std::string& line)>;

  // The log is off without a sink.
  explicit CallLog(Sink sink = {}) : sink_(std::move(sink)) {}
  bool is_on() const { return static_cast<bool>(sink_); }

  // Returns the notes of a running call, or null if the log is off. They live as long as the call.
  CallNotes* notes_of(const grpc::ServerContextBase& context) const;

  // Returns interceptors for grpc::ServerBuilder, which must not outlive this. When a call of isofield's services is
  // over, they write one line, such as
  //   call 17 MeshService/Mesh scene=neuron cells=263680: queue 0.1 ms, kernels 0.0 ms, device 95.3 ms,
  //   transfer 12.0 ms, total 120.5 ms, OK
  // `queue` is how long the work waited for its turn at the device, `kernels` how long it waited for the driver to
  // compile, `device` how long the device worked for it, and `transfer` how long it took to hand the answers to the
  // transport.
  std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> interceptors();

 private:
  class Call;
  class Calls;

  const Sink sink_;
  std::atomic<std::uint64_t> last_id_ = 0;
  mutable base::Mutex mutex_;
  std::map<const grpc::ServerContextBase*, CallNotes*> running_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::rpc
