// Tests points and results in memory that client and daemon share: right results, refusals, and memory that is given
// back.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <isofield/client.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "isofield/v1/shared_memory.pb.h"

namespace isofield::integration_test {
namespace {

constexpr int kSize = F_SEAL_SHRINK | F_SEAL_GROW;
constexpr std::size_t kBytes = 1 << 20;

// A connection to the daemon's second socket with a memfd, as the .proto file states it.
class Region {
 public:
  explicit Region(const std::string& socket_path, std::size_t bytes = kBytes, int seals = kSize,
                  const std::string& packet = "\1", std::size_t descriptors = 1)
      : bytes_(bytes) {
    socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    std::memcpy(name.sun_path, socket_path.data(), socket_path.size());
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0) << std::strerror(errno);
    descriptor_ = memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    EXPECT_EQ(ftruncate(descriptor_, static_cast<off_t>(bytes)), 0);
    EXPECT_EQ(fcntl(descriptor_, F_ADD_SEALS, seals), 0);
    if (bytes > 0) {
      data_ = static_cast<std::byte*>(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0));
    }
    answer_ = send(packet, std::vector<int>(descriptors, descriptor_));
  }
  ~Region() {
    if (data_) munmap(data_, bytes_);
    close(descriptor_);
    disconnect();
  }

  // Sends a packet and receives its answer.
  v1::OpenRegionResponse send(std::string bytes, std::vector<int> descriptors) {
    iovec data{bytes.data(), bytes.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(8 * sizeof(int))> control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    if (!descriptors.empty()) {
      message.msg_control = control.data();
      message.msg_controllen = CMSG_SPACE(descriptors.size() * sizeof(int));
      cmsghdr* const head = CMSG_FIRSTHDR(&message);
      head->cmsg_level = SOL_SOCKET;
      head->cmsg_type = SCM_RIGHTS;
      head->cmsg_len = CMSG_LEN(descriptors.size() * sizeof(int));
      std::memcpy(CMSG_DATA(head), descriptors.data(), descriptors.size() * sizeof(int));
    }
    EXPECT_EQ(sendmsg(socket_, &message, MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
    std::array<char, 4096> received;
    const ssize_t got = recv(socket_, received.data(), received.size(), 0);
    v1::OpenRegionResponse response;
    EXPECT_GT(got, 0);
    EXPECT_TRUE(response.ParseFromArray(received.data(), static_cast<int>(std::max<ssize_t>(got, 0))));
    return response;
  }
  // Waits until the daemon has closed its end.
  void wait_until_closed() {
    char byte = 0;
    EXPECT_EQ(recv(socket_, &byte, 1, 0), 0);
  }
  void disconnect() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }

  const v1::OpenRegionResponse& answer() const { return answer_; }
  int descriptor() const { return descriptor_; }
  void put(std::size_t offset, std::span<const float> numbers) {
    std::memcpy(data_ + offset, numbers.data(), numbers.size_bytes());
  }
  std::vector<float> get(std::size_t offset, std::size_t count) const {
    std::vector<float> numbers(count);
    std::memcpy(numbers.data(), data_ + offset, count * sizeof(float));
    return numbers;
  }
  v1::SharedTensor array(std::uint64_t offset, std::uint64_t rows, std::uint64_t columns) const {
    v1::SharedTensor tensor;
    tensor.set_region(answer_.region());
    tensor.set_offset(offset);
    tensor.set_dtype(v1::Tensor::FLOAT32);
    tensor.add_shape(rows);
    tensor.add_shape(columns);
    return tensor;
  }

 private:
  std::size_t bytes_;
  int socket_ = -1, descriptor_ = -1;
  std::byte* data_ = nullptr;
  v1::OpenRegionResponse answer_;
};

std::size_t descriptors_of(Process& process) {
  const std::filesystem::directory_iterator all("/proc/" + std::to_string(process.pid()) + "/fd"), end;
  return static_cast<std::size_t>(std::distance(all, end));
}

class SharedMemory : public testing::Test {
 protected:
  static constexpr std::size_t kPoints = 1000, kResultAt = 16'384;

  static void SetUpTestSuite() { daemon_ = new Daemon({"--shared-memory", "--max-shared-regions", "8"}); }
  static void TearDownTestSuite() {
    delete daemon_;
    daemon_ = nullptr;
  }
  void SetUp() override { socket_ = peer_.info().shared_memory_socket(); }

  v1::EvaluateRequest request(const Region& region, std::uint64_t columns = 4) {
    v1::EvaluateRequest r;
    *r.mutable_scene() = inlined(ball_.scene());
    r.set_quantity(columns == 4 ? v1::VALUE_AND_GRADIENT : v1::VALUE);
    *r.mutable_shared_points() = region.array(0, kPoints, 3);
    *r.mutable_shared_result() = region.array(kResultAt, kPoints, columns);
    return r;
  }
  void expect_refusal(const v1::EvaluateRequest& r, grpc::StatusCode code, const std::vector<std::string>& parts) {
    v1::EvaluateResponse response;
    expect_refused(peer_.evaluate(r, &response), code, parts);
  }

  static Daemon* daemon_;
  Ball ball_;
  Peer peer_{daemon_->address()};
  std::string socket_;
  std::vector<float> xyz_ = points_around(ball_, 1, kPoints);
};
Daemon* SharedMemory::daemon_ = nullptr;

TEST_F(SharedMemory, ResultsAreTheBitsOfTheWire) {
  Region region(socket_);
  ASSERT_EQ(region.answer().region().size(), 16u) << region.answer().message();
  region.put(0, xyz_);
  for (const std::uint64_t columns : {1u, 4u}) {
    std::vector<float> wire;
    ASSERT_TRUE(ok(peer_.evaluate(inlined(ball_.scene()), xyz_, columns == 4, &wire)));
    v1::EvaluateResponse response;
    ASSERT_TRUE(ok(peer_.evaluate(request(region, columns), &response)));
    EXPECT_FALSE(response.has_result());
    EXPECT_EQ(region.get(kResultAt, columns * kPoints), wire);
    // Next only the points are shared, and then only the results.
    v1::EvaluateRequest half = request(region, columns);
    half.clear_shared_result();
    ASSERT_TRUE(ok(peer_.evaluate(half, &response)));
    EXPECT_EQ(floats_of(response.result()), wire);
    half = request(region, columns);
    half.clear_shared_points();
    *half.mutable_points() = points_tensor(xyz_);
    region.put(kResultAt, std::vector<float>(columns * kPoints, -1));
    ASSERT_TRUE(ok(peer_.evaluate(half, &response)));
    EXPECT_EQ(region.get(kResultAt, columns * kPoints), wire);
  }
}

TEST_F(SharedMemory, TheClientGetsTheSameBitsAndSharesOneRegionAtATime) {
  const std::vector<float> many = points_around(ball_, 1, 400'000);
  ClientOptions options;
  options.shared_memory = true;
  auto sharing = Client::connect(daemon_->address(), options), plain = Client::connect(daemon_->address());
  ASSERT_TRUE(sharing.ok() && plain.ok());
  const auto wire = plain->evaluate(inline_scene(ball_.scene()), many, true);
  ASSERT_TRUE(wire.ok()) << wire.status();
  const std::size_t before = descriptors_of(daemon_->process());
  for (int i = 0; i < 3; ++i) {
    const auto shared = sharing->evaluate(inline_scene(ball_.scene()), many, true);
    ASSERT_TRUE(shared.ok()) << shared.status();
    EXPECT_EQ(*shared, *wire);
  }
  // One new descriptor is the side connection, the other one is a connection of gRPC.
  EXPECT_LE(descriptors_of(daemon_->process()), before + 2);
}

TEST_F(SharedMemory, StreamsTakeSeveralPlacesOfARegion) {
  Region region(socket_);
  constexpr std::size_t kStep = 32'768;
  std::vector<v1::EvaluateStreamRequest> requests(1);
  *requests[0].mutable_scene() = inlined(ball_.scene());
  for (std::size_t i = 0; i < 8; ++i) {
    region.put(i * kStep, points_around(ball_, i, kPoints));
    v1::EvaluateStreamRequest& r = requests.emplace_back();
    *r.mutable_shared_points() = region.array(i * kStep, kPoints, 3);
    *r.mutable_shared_result() = region.array(i * kStep + kResultAt, kPoints, 1);
  }
  std::vector<v1::EvaluateResponse> responses;
  ASSERT_TRUE(ok(peer_.evaluate_stream(requests, &responses)));
  ASSERT_EQ(responses.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_FALSE(responses[i].has_result());
    EXPECT_LE(ball_.errors(points_around(ball_, i, kPoints), region.get(i * kStep + kResultAt, kPoints)).value, 2e-5);
  }
}

TEST_F(SharedMemory, WhatDoesNotFitIsRefused) {
  Region region(socket_), other(socket_);
  region.put(0, xyz_);
  v1::EvaluateRequest r = request(region);
  const auto refused = [&](grpc::StatusCode code, const std::vector<std::string>& parts) {
    expect_refusal(r, code, parts);
    r = request(region);
  };
  using enum grpc::StatusCode;
  r.mutable_shared_points()->set_region(std::string(16, 'x'));
  refused(NOT_FOUND, {"shared_points.region", "no such region"});
  r.mutable_shared_result()->set_region("");
  refused(NOT_FOUND, {"shared_result.region"});
  r.mutable_shared_points()->set_offset(8);
  refused(INVALID_ARGUMENT, {"shared_points.offset = 8", "multiple of 16"});
  r.mutable_shared_result()->set_offset(kBytes - 15'984);
  refused(INVALID_ARGUMENT, {"shared_result", "within the region's 1048576 bytes"});
  for (const std::uint64_t offset : {std::uint64_t{kBytes}, std::uint64_t{1} << 63, ~std::uint64_t{15}}) {
    r.mutable_shared_points()->set_offset(offset);
    refused(INVALID_ARGUMENT, {"shared_points"});
  }
  r.mutable_shared_points()->set_shape(0, ~std::uint64_t{0});
  refused(RESOURCE_EXHAUSTED, {"shared_points.shape"});
  r.mutable_shared_points()->set_shape(1, 4);
  refused(INVALID_ARGUMENT, {"shared_points.shape", "[n, 3]"});
  r.mutable_shared_points()->set_dtype(v1::Tensor::UINT8);
  refused(INVALID_ARGUMENT, {"shared_points.dtype"});
  r.mutable_shared_result()->set_dtype(v1::Tensor::FLOAT64);
  refused(INVALID_ARGUMENT, {"shared_result.dtype", "FLOAT32"});
  r.mutable_shared_result()->set_shape(0, kPoints + 1);
  refused(INVALID_ARGUMENT, {"shared_result.shape = [1001, 4]", "[1000, 4]"});
  r.mutable_shared_result()->set_offset(11'984);
  refused(INVALID_ARGUMENT, {"overlaps"});
  *r.mutable_points() = points_tensor(xyz_);
  refused(INVALID_ARGUMENT, {"both stated"});
  std::vector<float> bad = xyz_;
  bad[4] = std::numeric_limits<float>::quiet_NaN();
  region.put(0, bad);
  refused(INVALID_ARGUMENT, {"shared_points[1].y = nan"});
  // The end of the region is still in it.
  region.put(0, xyz_);
  r.mutable_shared_result()->set_offset(kBytes - 16'000);
  v1::EvaluateResponse response;
  EXPECT_TRUE(ok(peer_.evaluate(r, &response)));
}

TEST_F(SharedMemory, MemoryThatCouldVanishIsRefused) {
  using enum grpc::StatusCode;
  for (const int seals : {0, F_SEAL_SHRINK, F_SEAL_GROW}) {
    Region region(socket_, kBytes, seals);
    EXPECT_EQ(region.answer().code(), INVALID_ARGUMENT);
    EXPECT_NE(region.answer().message().find("F_SEAL_SHRINK"), std::string::npos);
    EXPECT_TRUE(region.answer().region().empty());
    region.wait_until_closed();
  }
  Region empty(socket_, 0);
  EXPECT_EQ(empty.answer().code(), INVALID_ARGUMENT);
  Region large(socket_, (std::size_t{1} << 30) + 4096);
  EXPECT_EQ(large.answer().code(), RESOURCE_EXHAUSTED);
  EXPECT_NE(large.answer().message().find("--max-shared-bytes"), std::string::npos);
  // A connection has one region, and a packet has one descriptor.
  Region region(socket_);
  EXPECT_EQ(region.send("\1", {region.descriptor()}).code(), FAILED_PRECONDITION);
  region.wait_until_closed();
  for (const auto& [packet, descriptors] :
       {std::pair{"\1", 0}, {"\1", 2}, {"\1", 8}, {"\2", 1}, {"a packet that is longer than any", 1}}) {
    Region refused(socket_, kBytes, kSize, packet, descriptors);
    EXPECT_EQ(refused.answer().code(), INVALID_ARGUMENT);
    refused.wait_until_closed();
  }
  expect_serving(daemon_->address());
}

TEST_F(SharedMemory, ARegionEndsWithItsConnection) {
  Region region(socket_);
  region.put(0, xyz_);
  v1::EvaluateResponse response;
  ASSERT_TRUE(ok(peer_.evaluate(request(region), &response)));
  region.disconnect();
  // The daemon handles connections in order. When a new one is answered, it has seen the end of the old one.
  Region next(socket_);
  expect_refusal(request(region), grpc::StatusCode::NOT_FOUND, {"no such region"});
}

TEST_F(SharedMemory, ClientsThatComeAndGoLeaveNothing) {
  { Region region(socket_); }
  Region first(socket_);
  const std::size_t before = descriptors_of(daemon_->process());
  for (int i = 0; i < 50; ++i) {
    Region region(socket_);
    region.put(0, xyz_);
    v1::EvaluateResponse response;
    EXPECT_TRUE(ok(peer_.evaluate(request(region), &response)));
    Region refused(socket_, kBytes, 0);
  }
  Region last(socket_);
  EXPECT_LE(descriptors_of(daemon_->process()), before + 1);
}

TEST_F(SharedMemory, AClientThatScribblesSpoilsItsOwnResultsAlone) {
  // Small calls on one kept scene go to the device together.
  ASSERT_TRUE(ok(peer_.put("ball", ball_.scene())));
  const auto call_on = [&](const Region& region) {
    v1::EvaluateRequest r = request(region);
    *r.mutable_scene() = named("ball");
    return r;
  };
  Region scribbled(socket_), other(socket_);
  std::atomic<bool> is_over = false;
  std::thread scribbler([&] {
    const std::vector<float> wild(3 * kPoints, std::numeric_limits<float>::quiet_NaN());
    while (!is_over) {
      scribbled.put(0, wild);
      scribbled.put(kResultAt, wild);
      scribbled.put(0, xyz_);
    }
  });
  std::thread caller([&] {
    Peer peer(daemon_->address());
    for (int i = 0; i < 100; ++i) {
      v1::EvaluateResponse response;
      const grpc::Status status = peer.evaluate(call_on(scribbled), &response);
      if (!status.ok()) expect_refused(status, grpc::StatusCode::INVALID_ARGUMENT, {"expected a finite float32"});
    }
    is_over = true;
  });
  // Meanwhile another client asks for points of its own, in shared memory and over the wire.
  for (std::uint64_t round = 1; !is_over; ++round) {
    const std::vector<float> points = points_around(ball_, 1000 * round, kPoints);
    other.put(0, points);
    other.put(kResultAt, std::vector<float>(4 * kPoints, -1));
    v1::EvaluateResponse response;
    EXPECT_TRUE(ok(peer_.evaluate(call_on(other), &response)));
    const std::vector<float> shared = other.get(kResultAt, 4 * kPoints);
    std::vector<float> wire;
    EXPECT_TRUE(ok(peer_.evaluate(named("ball"), points, true, &wire)));
    for (const std::vector<float>& results : {shared, wire}) {
      EXPECT_EQ(results.size(), 4 * kPoints);
      if (results.size() != 4 * kPoints) continue;
      const Ball::Errors errors = ball_.errors(points, results);
      EXPECT_LE(errors.value, 2e-5);
      EXPECT_LE(errors.gradient, 1e-3);
    }
    EXPECT_EQ(other.get(0, 3 * kPoints), points) << "points are only read";
  }
  caller.join();
  scribbler.join();
  EXPECT_TRUE(ok(peer_.remove("ball")));
  expect_serving(daemon_->address());
}

TEST(SharedMemoryOff, ByDefaultItIsRefusedAndTheClientTakesTheWire) {
  const std::string& address = shared_daemon().address();
  Peer peer(address);
  EXPECT_EQ(peer.info().shared_memory_socket(), "");
  const Ball ball;
  v1::EvaluateRequest request;
  *request.mutable_scene() = inlined(ball.scene());
  request.mutable_shared_points()->set_dtype(v1::Tensor::FLOAT32);
  v1::EvaluateResponse response;
  expect_refused(peer.evaluate(request, &response), grpc::StatusCode::FAILED_PRECONDITION, {"--shared-memory"});
  ClientOptions options;
  options.shared_memory = true;
  auto client = Client::connect(address, options);
  ASSERT_TRUE(client.ok());
  const std::vector<float> xyz = points_around(ball, 1, 100'000);
  const auto results = client->evaluate(inline_scene(ball.scene()), xyz, false);
  ASSERT_TRUE(results.ok()) << results.status();
  EXPECT_LE(ball.errors(xyz, *results).value, 2e-5);
}

TEST(SharedMemoryOff, OverTcpThereIsNone) {
  const Outcome outcome = run(daemon_command({"--listen", "127.0.0.1:0", "--shared-memory"}));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.errors.find("--shared-memory: expected --listen unix:PATH"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace isofield::integration_test
