// Tests a server at its limits: it refuses calls of every kind at once, tells when to come again, and serves them then.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

v1::EvaluateGridRequest grid_of(std::uint64_t edge) {
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  for (int i = 0; i < 3; ++i) {
    request.add_origin(-1);
    request.add_counts(edge);
  }
  request.add_spacing(2.0 / static_cast<double>(edge));
  return request;
}

// Keeps a grid at work. The grid is far more than fits between server and client, and only one message of it is read.
class OpenGrid {
 public:
  explicit OpenGrid(Peer& peer) : stream_(peer.fields().EvaluateGrid(&context_, grid_of(400))) {
    v1::EvaluateGridResponse response;
    EXPECT_TRUE(stream_->Read(&response));
  }
  ~OpenGrid() {
    context_.TryCancel();
    stream_->Finish();
  }

 private:
  LimitedContext context_;
  std::unique_ptr<grpc::ClientReader<v1::EvaluateGridResponse>> stream_;
};

grpc::Status evaluate_grid(Peer& peer, grpc::ClientContext& context) {
  const auto stream = peer.fields().EvaluateGrid(&context, grid_of(8));
  v1::EvaluateGridResponse response;
  while (stream->Read(&response)) continue;
  return stream->Finish();
}

// Returns milliseconds, or 0 if the server does not say when to come again.
int pushback(const grpc::ClientContext& context) {
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto hint = trailers.find("grpc-retry-pushback-ms");
  return hint == trailers.end() ? 0 : std::stoi(std::string(hint->second.data(), hint->second.size()));
}

void expect_served_soon(const std::function<grpc::Status()>& call) {
  grpc::Status status = call();
  for (int tries = 0; status.error_code() == StatusCode::RESOURCE_EXHAUSTED && tries < 1000; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    status = call();
  }
  EXPECT_TRUE(ok(status));
}

TEST(Admission, PointsOfAllKindsShareALimit) {
  Daemon daemon({"--max-running-points", "1000"});
  Peer peer(daemon.address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, 10);
  v1::CastRaysRequest rays;
  *rays.mutable_scene() = inlined(ball.scene());
  *rays.mutable_origins() = points_tensor(std::span<const float>(xyz));
  *rays.mutable_directions() = points_tensor(std::span<const float>(std::vector<float>(xyz.size(), 1)));
  {
    const OpenGrid open(peer);  // the points are more than is admitted, but nothing else was there
    LimitedContext context;
    expect_refused(evaluate_grid(peer, context), StatusCode::RESOURCE_EXHAUSTED,
                   {"64000000 points", "1000 are admitted", "--max-running-points", "try again in"});
    EXPECT_GE(pushback(context), 1);
    ReceivedMesh mesh;
    expect_refused(peer.mesh(mesh_request(inlined(ball.scene()), 0.1), &mesh), StatusCode::RESOURCE_EXHAUSTED,
                   {"--max-running-points"});
    LimitedContext ray_context;
    v1::CastRaysResponse hits;
    expect_refused(peer.surfaces().CastRays(&ray_context, rays, &hits), StatusCode::RESOURCE_EXHAUSTED,
                   {"--max-running-points"});
    EXPECT_GE(pushback(ray_context), 1);
    // Evaluate has limits of its own, and calls without such work have none.
    std::vector<float> results;
    EXPECT_TRUE(ok(peer.evaluate(inlined(ball.scene()), xyz, true, &results)));
    EXPECT_TRUE(ok(peer.put("ball", ball.scene())));
  }
  expect_served_soon([&] {
    LimitedContext context;
    return evaluate_grid(peer, context);
  });
  expect_served_soon([&] {
    LimitedContext context;
    v1::CastRaysResponse hits;
    return peer.surfaces().CastRays(&context, rays, &hits);
  });
}

TEST(Admission, CallsOfAllKindsShareALimit) {
  Daemon daemon({"--max-running-requests", "1"});
  Peer peer(daemon.address());
  const Ball ball;
  ASSERT_TRUE(ok(peer.put("ball", ball.scene())));
  {
    const OpenGrid open(peer);
    const std::vector<std::string> refusal{"1 requests", "1 with", "--max-running-requests"};
    expect_refused(peer.put("other", ball.scene()), StatusCode::RESOURCE_EXHAUSTED, refusal);
    expect_refused(peer.remove("ball"), StatusCode::RESOURCE_EXHAUSTED, refusal);
    LimitedContext context;
    expect_refused(evaluate_grid(peer, context), StatusCode::RESOURCE_EXHAUSTED, refusal);
    EXPECT_GE(pushback(context), 1);
    std::vector<float> results;
    EXPECT_TRUE(ok(peer.evaluate(named("ball"), points_around(ball, 1, 10), true, &results)));
    EXPECT_EQ(peer.info().limits().max_running_requests(), 1u) << "a full server tells about itself";
  }
  expect_served_soon([&] { return peer.remove("ball"); });
}

}  // namespace
}  // namespace isofield::integration_test
