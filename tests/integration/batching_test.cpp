// Tests many requests at once: small ones are joined and pass large ones, and a full queue says when to come back.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/eventually.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

v1::EvaluateRequest request_of(const v1::SceneRef& scene, std::span<const float> xyz) {
  v1::EvaluateRequest request;
  *request.mutable_scene() = scene;
  request.set_quantity(v1::VALUE_AND_GRADIENT);
  request.set_max_answer_bytes(64u << 20);
  *request.mutable_points() = points_tensor(xyz);
  return request;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Batching, EachOfManyClientsGetsItsOwnBits) {
  constexpr int kClients = 48, kCalls = 20;
  const std::string& address = shared_daemon().address();
  Peer peer(address);
  const Ball ball;
  ASSERT_TRUE(ok(peer.put("ball", ball.scene())));
  // The tape is long, and each joined batch is sorted in its own way.
  ASSERT_TRUE(ok(peer.put("blend", test_support::random_scene(12, {.nodes = 60}))));
  struct Client {
    std::string scene;
    std::vector<float> xyz, alone;
    bool are_same = true;
    grpc::Status status;
    std::thread thread;
  };
  std::vector<Client> clients(kClients);
  for (int i = 0; i < kClients; ++i) {
    Client& c = clients[i];
    c.scene = i % 3 == 0 ? "blend" : "ball";
    c.xyz = points_around(ball, i, 1 + 7 * i);
    ASSERT_TRUE(ok(peer.evaluate(named(c.scene), c.xyz, true, &c.alone)));
    if (c.scene == "ball") {
      EXPECT_LE(ball.errors(c.xyz, c.alone).value, 2e-5);
    }
  }
  for (Client& c : clients) {
    c.thread = std::thread([&c, &address] {
      Peer own(address);
      for (int call = 0; call < kCalls && c.status.ok(); ++call) {
        std::vector<float> results;
        c.status = own.evaluate(named(c.scene), c.xyz, true, &results);
        c.are_same &= same_bits(results, c.alone);
      }
    });
  }
  for (Client& c : clients) {
    c.thread.join();
    EXPECT_TRUE(ok(c.status));
    EXPECT_TRUE(c.are_same);
  }
  EXPECT_TRUE(ok(peer.remove("ball")));
  EXPECT_TRUE(ok(peer.remove("blend")));
}

// A call of some seconds of work, of which nothing can be culled. The test ends it.
class LargeCall {
 public:
  explicit LargeCall(const std::string& address) : peer_(address) {
    v1::Scene scene;
    v1::Node blend;
    for (int i = 0; i < 100; ++i) {
      v1::Sphere& s = *scene.add_nodes()->mutable_sphere();
      s.set_radius(1);
      s.set_range(1 + i * 1e-3);
      blend.mutable_gradient()->add_children(test_support::place(i));
    }
    *scene.add_nodes() = blend;
    const std::vector<float> xyz = points_around(Ball(), 3, 262'144);
    const v1::EvaluateRequest request = request_of(inlined(scene), xyz);
    const std::uint64_t before = peer_.info().device_bytes();
    thread_ = std::thread([this, request] {
      v1::EvaluateResponse response;
      status_ = peer_.fields().Evaluate(&context_, request, &response);
      is_done_ = true;
    });
    // The call has begun when its points are on the device.
    const std::uint64_t begun = before + xyz.size() * sizeof(float);
    EXPECT_TRUE(test_support::eventually([&] { return peer_.info().device_bytes() >= begun || is_done_; }));
    EXPECT_FALSE(is_done_) << "the call has ended already";
  }
  ~LargeCall() { cancel(); }

  grpc::Status cancel() {
    context_.TryCancel();
    if (thread_.joinable()) thread_.join();
    return status_;
  }

 private:
  Peer peer_;
  LimitedContext context_;
  grpc::Status status_;
  std::atomic<bool> is_done_ = false;
  std::thread thread_;
};

TEST(Batching, ASmallCallIsAnsweredWhileALargeOneRuns) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, 64);
  std::vector<float> results;
  ASSERT_TRUE(ok(peer.evaluate(inlined(ball.scene()), xyz, true, &results)));  // compiles the kernel first
  LargeCall large(shared_daemon().address());
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(ok(peer.evaluate(inlined(ball.scene()), xyz, true, &results)));
    EXPECT_LE(ball.errors(xyz, results).value, 2e-5);
  }
  EXPECT_EQ(large.cancel().error_code(), grpc::StatusCode::CANCELLED) << "it was still at work";
}

TEST(Batching, AFullQueueRefusesAtOnceAndSaysWhenToTryAgain) {
  Daemon daemon({"--max-queued-points", "1000"});
  Peer peer(daemon.address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, 64);
  LargeCall large(daemon.address());  // more than is admitted, but nothing else was there
  LimitedContext context;
  v1::EvaluateResponse response;
  const grpc::Status status = peer.fields().Evaluate(&context, request_of(inlined(ball.scene()), xyz), &response);
  expect_refused(status, grpc::StatusCode::RESOURCE_EXHAUSTED,
                 {"1 requests", "262144 points", "--max-queued-points", "try again in"});
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto hint = trailers.find("grpc-retry-pushback-ms");
  ASSERT_NE(hint, trailers.end());
  EXPECT_GE(std::stoi(std::string(hint->second.data(), hint->second.size())), 1);
  // A stream waits instead of being refused.
  v1::EvaluateStreamRequest message;
  *message.mutable_scene() = inlined(ball.scene());
  *message.mutable_points() = points_tensor(xyz);
  std::vector<v1::EvaluateResponse> responses;
  EXPECT_TRUE(ok(peer.evaluate_stream({message}, &responses)));
  EXPECT_EQ(large.cancel().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(Batching, PrioritiesAreThoseThatHaveANumber) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  v1::EvaluateRequest request = request_of(inlined(ball.scene()), points_around(ball, 1, 10));
  v1::EvaluateResponse response;
  for (const v1::Priority p : {v1::PRIORITY_LOW, v1::PRIORITY_NORMAL, v1::PRIORITY_HIGH}) {
    request.set_priority(p);
    EXPECT_TRUE(ok(peer.evaluate(request, &response)));
  }
  request.set_priority(static_cast<v1::Priority>(9));
  expect_refused(peer.evaluate(request, &response), grpc::StatusCode::INVALID_ARGUMENT,
                 {"priority = 9", "PRIORITY_HIGH"});
  std::vector<v1::EvaluateStreamRequest> messages(2);
  *messages[0].mutable_scene() = inlined(ball.scene());
  messages[1].set_priority(v1::PRIORITY_LOW);
  std::vector<v1::EvaluateResponse> responses;
  expect_refused(peer.evaluate_stream(messages, &responses), grpc::StatusCode::INVALID_ARGUMENT,
                 {"priority", "first message"});
}

}  // namespace
}  // namespace isofield::integration_test
