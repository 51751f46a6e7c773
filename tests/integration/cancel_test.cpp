// Tests that the work stops, and what it held is returned, when clients give up or go away.
#include <gtest/gtest.h>
#include <isofield/client.h>
#include <signal.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

// The mesh has nearly as many cells as are admitted, which is some seconds of work.
constexpr double kTinyCell = 0.0022;

class Cancel : public testing::Test {
 protected:
  void SetUp() override {
    bytes_before_ = peer_.info().device_bytes();
    ASSERT_TRUE(ok(peer_.put("ball", ball_.scene())));
  }
  void TearDown() override {
    // Work that goes on still holds the scene.
    EXPECT_TRUE(ok(peer_.remove("ball")));
    wait_until([&](std::uint64_t bytes) { return bytes == bytes_before_; });
    expect_serving(shared_daemon().address());
    ReceivedMesh mesh;
    EXPECT_TRUE(ok(peer_.mesh(mesh_request(inlined(ball_.scene()), 0.05), &mesh)));
  }

  // The limit ends a test that would hang otherwise.
  void wait_until(const std::function<bool(std::uint64_t bytes)>& reached) {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    for (std::uint64_t bytes = 0; !reached(bytes = peer_.info().device_bytes());) {
      ASSERT_LT(std::chrono::steady_clock::now(), limit)
          << "the work goes on: " << bytes << " bytes on the device, " << bytes_before_ << " before it";
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  Ball ball_;
  Peer peer_{shared_daemon().address()};
  std::uint64_t bytes_before_ = 0;
};

TEST_F(Cancel, OfAMeshStopsTheWork) {
  grpc::ClientContext context;
  const auto stream = peer_.meshes().Mesh(&context, mesh_request(named("ball"), kTinyCell));
  v1::MeshResponse response;
  ASSERT_TRUE(stream->Read(&response));
  ASSERT_TRUE(response.has_progress());
  EXPECT_LT(response.progress().fraction(), 1);
  context.TryCancel();
  while (stream->Read(&response)) EXPECT_FALSE(response.has_summary());
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(Cancel, ByTheClientLibraryStopsTheWork) {
  auto client = Client::connect(shared_daemon().address());
  ASSERT_TRUE(client.ok());
  double seen = -1;
  const auto mesh = client->mesh(mesh_request(named("ball"), kTinyCell), [&](const v1::MeshProgress& progress) {
    seen = progress.fraction();
    return false;
  });
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kCancelled);
  EXPECT_GE(seen, 0);
}

TEST_F(Cancel, ByDeadlineStopsTheWork) {
  ClientOptions options;
  options.stream_timeout = std::chrono::milliseconds(300);
  auto client = Client::connect(shared_daemon().address(), options);
  ASSERT_TRUE(client.ok());
  const auto mesh = client->mesh(mesh_request(named("ball"), kTinyCell));
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kDeadlineExceeded);
}

TEST_F(Cancel, ByAKilledClientStopsTheWork) {
  const TemporaryDirectory directory;
  Process command({ISOFIELD_COMMAND, "--server", shared_daemon().address(), "mesh", "ball", "--cell",
                   std::to_string(kTinyCell), "-o", directory.path("ball.glb")});
  wait_until([&](std::uint64_t bytes) { return bytes > bytes_before_ + (1 << 20) || !command.is_running(); });
  command.signal(SIGKILL);
  EXPECT_EQ(command.wait(), 128 + SIGKILL);
  EXPECT_EQ(directory.listing(), "");
}

TEST_F(Cancel, OfTheSearchForCellsStopsTheWork) {
  // The mesh has nearly as many cells as are admitted. No estimate refuses them, and finding them takes long.
  v1::Scene scene;
  v1::Node all;
  for (int i = 0; i < 30'000; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (const int x : {i % 32, i / 32 % 32, i / 1024}) s->add_center(x);
    s->set_radius(0.4);
    s->set_range(0.4);
    all.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = all;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(250));
  const auto stream = peer_.meshes().Mesh(&context, mesh_request(inlined(scene), 0.08));
  v1::MeshResponse response;
  while (stream->Read(&response)) EXPECT_TRUE(response.has_progress());
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
}

TEST_F(Cancel, OfAStreamOfPointsEndsIt) {
  const std::vector<float> xyz = points_around(ball_, 1, 65'536);
  grpc::ClientContext context;
  const auto stream = peer_.fields().EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = named("ball");
  *request.mutable_points() = points_tensor(std::span(xyz));
  ASSERT_TRUE(stream->Write(request));
  v1::EvaluateResponse response;
  ASSERT_TRUE(stream->Read(&response));
  context.TryCancel();
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(Cancel, OfAGridEndsIt) {
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = named("ball");
  for (int a = 0; a < 3; ++a) {
    request.add_origin(-2);
    request.add_spacing(0.004);
    request.add_counts(1000);
  }
  grpc::ClientContext context;
  const auto stream = peer_.fields().EvaluateGrid(&context, request);
  v1::EvaluateGridResponse response;
  ASSERT_TRUE(stream->Read(&response));
  context.TryCancel();
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

}  // namespace
}  // namespace isofield::integration_test
