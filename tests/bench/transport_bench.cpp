// Measures what the way to a daemon costs: transport_bench TCP_ADDRESS UNIX_ADDRESS [REPETITIONS]
//
// The client library sends a million points and receives their values and gradients: from one daemon over TCP, from
// another over a unix socket and through shared memory, and from services that take and answer as many bytes over the
// same transports. The transports take turns. The best of the repetitions counts, because the machine is shared.
#include <grpcpp/grpcpp.h>
#include <isofield/client.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "blobtree/primitives/falloff.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPoints = 1 << 20;

void check(const absl::Status& status) {
  if (status.ok()) return;
  std::cerr << status << "\n";
  std::exit(1);
}

// Returns the sum of raw soft spheres in the cube [-1, 1]^3, as in bench.cpp, moved along x.
v1::Scene soft_spheres(int count, double offset) {
  test_support::Random random(42);
  v1::Scene scene;
  v1::Node sum;
  for (int i = 0; i < count; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-1, 1) + (a == 0 ? offset : 0));
    s->set_radius(blobtree::kR0 * 0.9);
    s->set_range((1 - blobtree::kR0) * 0.9);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = sum;
  return scene;
}

// Answers each point with as many bytes as a value and a gradient have.
class Echo final : public v1::FieldService::Service {
  grpc::Status EvaluateStream(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::EvaluateResponse, v1::EvaluateStreamRequest>* stream) override {
    v1::EvaluateStreamRequest request;
    v1::EvaluateResponse response;
    v1::Tensor& result = *response.mutable_result();
    result.set_dtype(v1::Tensor::FLOAT32);
    while (stream->Read(&request)) {
      result.clear_shape();
      result.add_shape(request.points().shape(0));
      result.add_shape(4);
      result.mutable_data()->resize(16 * request.points().shape(0));
      stream->Write(response);
    }
    return grpc::Status::OK;
  }
};

// Owns a process that serves Echo with the daemon's settings until this object ends. It must be made before gRPC is
// used here.
class EchoProcess {
 public:
  explicit EchoProcess(const std::string& listen) {
    int ready[2];
    if (pipe(ready) != 0) std::exit(1);
    pid_ = fork();
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      serve(listen, ready[1]);
    }
    close(ready[1]);
    int port = 0;
    if (read(ready[0], &port, sizeof(port)) != sizeof(port)) std::exit(1);
    close(ready[0]);
    address_ = listen.starts_with("unix:") ? listen : "127.0.0.1:" + std::to_string(port);
  }
  ~EchoProcess() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  const std::string& address() const { return address_; }

 private:
  [[noreturn]] static void serve(const std::string& listen, int ready) {
    Echo echo;
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort(listen, grpc::InsecureServerCredentials(), &port);
    builder.SetMaxReceiveMessageSize(64 << 20);
    builder.RegisterService(&echo);
    const std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
    if (!server || write(ready, &port, sizeof(port)) != sizeof(port)) _exit(1);
    server->Wait();
    _exit(0);
  }

  pid_t pid_;
  std::string address_;
};

struct Row {
  std::string name;
  Client client;
  double best = 1e9;  // seconds
};

Client connect(const std::string& address, bool shared_memory = false) {
  ClientOptions options;
  options.shared_memory = shared_memory;
  auto client = Client::connect(address, options);
  check(client.status());
  return *std::move(client);
}

void compare(std::vector<Row>& rows, const v1::SceneRef& scene, std::span<const float> xyz, int repetitions) {
  for (Row& row : rows) row.best = 1e9;
  std::vector<float> results(4 * xyz.size() / 3);
  for (int i = 0; i <= repetitions; ++i) {  // the first round makes connections and compiles kernels
    for (Row& row : rows) {
      const Clock::time_point start = Clock::now();
      check(row.client.evaluate(scene, xyz, true, results));
      if (i > 0) row.best = std::min(row.best, std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  std::printf("%s\n", scene.name().c_str());
  for (const Row& row : rows) {
    std::printf("  %-28s %8.1f ms %8.1f M points/s\n", row.name.c_str(), 1e3 * row.best, kPoints / row.best / 1e6);
  }
  std::printf("  %-28s %8.2f\n", "isofieldd to echo, TCP", rows[0].best / rows[1].best);
  std::printf("  %-28s %8.2f\n", "isofieldd to echo, unix", rows[2].best / rows[3].best);
  std::printf("  %-28s %8.2f\n", "shared memory to TCP", rows[1].best / rows[4].best);
}

void run(const std::string& tcp, const std::string& socket, int repetitions) {
  const std::string echo_path = "/tmp/isofield-echo-" + std::to_string(getpid());
  const EchoProcess tcp_echo("127.0.0.1:0"), unix_echo("unix:" + echo_path);
  std::vector<Row> rows;
  rows.push_back({"echo, TCP", connect(tcp_echo.address())});
  rows.push_back({"isofieldd, TCP", connect(tcp)});
  rows.push_back({"echo, unix socket", connect(unix_echo.address())});
  rows.push_back({"isofieldd, unix socket", connect(socket)});
  rows.push_back({"isofieldd, shared memory", connect(socket, true)});
  const auto info = rows.back().client.info();
  check(info.status());
  if (info->shared_memory_socket().empty()) std::cerr << socket << " shares no memory: start it with --shared-memory\n";

  test_support::Random random(1);
  std::vector<float> xyz(3 * kPoints);
  for (float& x : xyz) x = static_cast<float>(random.number(-1, 1));
  struct Case {
    std::string name;
    int spheres;
    double offset;
  };
  // If no sphere is near, no kernel runs, and the row shows only the daemon's part of the transport.
  for (const Case& c : {Case{"8-spheres", 8, 0}, Case{"1-sphere", 1, 0}, Case{"64-spheres-far-away", 64, 100}}) {
    for (const std::string& daemon : {tcp, socket}) {
      check(connect(daemon).put_scene(c.name, soft_spheres(c.spheres, c.offset)).status());
    }
    compare(rows, scene_by_name(c.name), xyz, repetitions);
  }
  unlink(echo_path.c_str());
}

}  // namespace
}  // namespace isofield

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::cerr << "usage: transport_bench TCP_ADDRESS UNIX_ADDRESS [REPETITIONS]\n";
    return 2;
  }
  isofield::run(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 20);
}
