// Measures what many clients with small requests get of one daemon: clients_bench ADDRESS [SECONDS]
//
// Each client has a connection of its own and one call open at a time. One thread drives all of them, so that their own
// work takes as little of the machine as it can.
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "blobtree/primitives/falloff.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "isofield/v1/info_service.grpc.pb.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSpheres = 8;
constexpr int kClients = 64;
constexpr int kPoints = 64;

void check(const grpc::Status& status) {
  if (status.ok()) return;
  std::cerr << status.error_message() << "\n";
  std::exit(1);
}

// Returns the sum of raw soft spheres in the cube [-1, 1]^3, as in bench.cpp.
v1::Scene soft_spheres() {
  test_support::Random random(42);
  v1::Scene scene;
  v1::Node sum;
  for (int i = 0; i < kSpheres; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-1, 1));
    s->set_radius(blobtree::kR0 * 0.9);
    s->set_range((1 - blobtree::kR0) * 0.9);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = sum;
  return scene;
}

std::shared_ptr<grpc::Channel> connect(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetMaxReceiveMessageSize(-1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

// One client that sends one kind of request over and over.
class Caller {
 public:
  virtual ~Caller() = default;
  virtual void start(grpc::CompletionQueue& queue) = 0;
  grpc::Status status;
  Clock::time_point began;
};

class EvaluateCaller final : public Caller {
 public:
  EvaluateCaller(const std::string& address, int seed, int points)
      : stub_(v1::FieldService::NewStub(connect(address))) {
    test_support::Random random(seed);
    std::vector<float> xyz(3 * points);
    for (float& x : xyz) x = static_cast<float>(random.number(-1, 1));
    request_.mutable_scene()->set_name("bench");
    request_.set_quantity(v1::VALUE_AND_GRADIENT);
    request_.set_max_answer_bytes(64 << 20);
    v1::Tensor& tensor = *request_.mutable_points();
    tensor.set_dtype(v1::Tensor::FLOAT32);
    tensor.add_shape(points);
    tensor.add_shape(3);
    tensor.set_data(xyz.data(), xyz.size() * sizeof(float));
  }
  void start(grpc::CompletionQueue& queue) override {
    context_ = std::make_unique<grpc::ClientContext>();
    began = Clock::now();
    call_ = stub_->AsyncEvaluate(context_.get(), request_, &queue);
    call_->Finish(&response_, &status, this);
  }

  const v1::EvaluateRequest& request() const { return request_; }

 private:
  std::unique_ptr<v1::FieldService::Stub> stub_;
  v1::EvaluateRequest request_;
  v1::EvaluateResponse response_;
  std::unique_ptr<grpc::ClientContext> context_;
  std::unique_ptr<grpc::ClientAsyncResponseReader<v1::EvaluateResponse>> call_;
};

class InfoCaller final : public Caller {
 public:
  explicit InfoCaller(const std::string& address) : stub_(v1::InfoService::NewStub(connect(address))) {}
  void start(grpc::CompletionQueue& queue) override {
    context_ = std::make_unique<grpc::ClientContext>();
    began = Clock::now();
    call_ = stub_->AsyncGetInfo(context_.get(), {}, &queue);
    call_->Finish(&response_, &status, this);
  }

 private:
  std::unique_ptr<v1::InfoService::Stub> stub_;
  v1::GetInfoResponse response_;
  std::unique_ptr<grpc::ClientContext> context_;
  std::unique_ptr<grpc::ClientAsyncResponseReader<v1::GetInfoResponse>> call_;
};

struct Row {
  double calls_per_second = 0, mean = 0, p50 = 0, p99 = 0;  // latencies in microseconds
};

// Measures `callers` that each keep one call open, or that take turns with one open call in all.
Row measure(const std::vector<std::unique_ptr<Caller>>& callers, bool in_turn, double seconds) {
  grpc::CompletionQueue queue;
  std::vector<double> latencies;
  const std::size_t total = callers.size();
  std::size_t next = 0, open = 0;
  const auto start_next = [&] {
    callers[next++ % total]->start(queue);
    ++open;
  };
  // The first calls make the connections and compile the kernels.
  for (std::size_t i = 0; i < total; ++i) {
    start_next();
    void* tag = nullptr;
    bool is_ok = false;
    queue.Next(&tag, &is_ok);
    check(static_cast<Caller*>(tag)->status);
    --open;
  }
  const Clock::time_point start = Clock::now();
  const Clock::time_point end =
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (std::size_t i = 0; i < (in_turn ? 1 : total); ++i) start_next();
  void* tag = nullptr;
  bool is_ok = false;
  Clock::time_point now = start;
  while (open > 0 && queue.Next(&tag, &is_ok)) {
    auto* caller = static_cast<Caller*>(tag);
    check(caller->status);
    now = Clock::now();
    latencies.push_back(std::chrono::duration<double, std::micro>(now - caller->began).count());
    --open;
    if (now >= end) continue;
    if (in_turn) {
      start_next();
    } else {
      caller->start(queue);
      ++open;
    }
  }
  Row row;
  row.calls_per_second = static_cast<double>(latencies.size()) / std::chrono::duration<double>(now - start).count();
  std::sort(latencies.begin(), latencies.end());
  for (const double l : latencies) row.mean += l / static_cast<double>(latencies.size());
  row.p50 = latencies[latencies.size() / 2];
  row.p99 = latencies[latencies.size() * 99 / 100];
  return row;
}

void print(const std::string& name, const char* how, const Row& row, int points) {
  std::printf("%-32s %-14s %9.0f %12.0f %9.0f %9.0f %9.0f %9.2f\n", name.c_str(), how, row.calls_per_second,
              row.calls_per_second * points, row.mean, row.p50, row.p99, row.p99 / row.mean);
}

void compare(const std::string& name, const std::function<std::unique_ptr<Caller>(int client)>& make, int points,
             double seconds) {
  std::vector<std::unique_ptr<Caller>> callers;
  for (int i = 0; i < kClients; ++i) callers.push_back(make(i));
  const Row one = measure(callers, true, seconds), all = measure(callers, false, seconds);
  print(name, "one at a time", one, points);
  print(name, "64 at once", all, points);
  std::printf("%-32s %-14s %9.2f\n\n", name.c_str(), "ratio", all.calls_per_second / one.calls_per_second);
}

// Measures one small call at a time while another client does `work` over and over.
void beside(const std::string& name, const std::string& address, double seconds,
            const std::function<void(grpc::ClientContext&)>& work) {
  std::vector<std::unique_ptr<Caller>> callers;
  callers.push_back(std::make_unique<EvaluateCaller>(address, 0, kPoints));
  std::atomic<bool> is_over = false;
  std::thread other([&] {
    while (!is_over) {
      grpc::ClientContext context;
      work(context);
    }
  });
  const Row row = measure(callers, true, seconds);
  is_over = true;
  other.join();
  print(name, "one at a time", row, kPoints);
}

void small_beside_large(const std::string& address, double seconds) {
  const auto fields = v1::FieldService::NewStub(connect(address));
  const auto meshes = v1::MeshService::NewStub(connect(address));
  const EvaluateCaller large(address, 1, 1 << 20);
  v1::EvaluateResponse response;
  beside("64 points beside 1 M points", address, seconds,
         [&](grpc::ClientContext& context) { check(fields->Evaluate(&context, large.request(), &response)); });
  v1::MeshRequest request;
  request.mutable_scene()->set_name("bench");
  request.set_cell_size(0.008);
  beside("64 points beside meshes", address, seconds, [&](grpc::ClientContext& context) {
    const auto stream = meshes->Mesh(&context, request);
    v1::MeshResponse part;
    while (stream->Read(&part)) continue;
    check(stream->Finish());
  });
}

}  // namespace
}  // namespace isofield

int main(int argc, char** argv) {
  using namespace isofield;
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: clients_bench ADDRESS [SECONDS]\n";
    return 2;
  }
  const std::string address = argv[1];
  const double seconds = argc > 2 ? std::atof(argv[2]) : 3;
  const auto scenes = v1::SceneService::NewStub(connect(address));
  v1::PutSceneRequest put;
  put.set_name("bench");
  *put.mutable_scene() = soft_spheres();
  grpc::ClientContext context;
  v1::PutSceneResponse stored;
  check(scenes->PutScene(&context, put, &stored));
  std::printf("%-32s %-14s %9s %12s %9s %9s %9s %9s\n", "request", "", "calls/s", "points/s", "mean us", "p50 us",
              "p99 us", "p99/mean");
  compare(
      "GetInfo", [&](int) { return std::make_unique<InfoCaller>(address); }, 0, seconds);
  compare(
      "Evaluate, 0 points", [&](int i) { return std::make_unique<EvaluateCaller>(address, i, 0); }, 0, seconds);
  compare(
      "Evaluate, 64 points", [&](int i) { return std::make_unique<EvaluateCaller>(address, i, kPoints); }, kPoints,
      seconds);
  small_beside_large(address, seconds);
}
