// Tests that the work stops, and what it held is returned, when clients give up or go away.
#include <gtest/gtest.h>
#include <isofield/client.h>
#include <signal.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <regex>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/eventually.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

// The mesh has nearly as many cells as are admitted, which is some seconds of work.
constexpr double kTinyCell = 0.0022;

// The tests share a daemon that logs its calls. The line of a call is written when the server has ended its work.
class Cancel : public testing::Test {
 protected:
  static void SetUpTestSuite() { daemon_ = std::make_unique<Daemon>(std::vector<std::string>{"--log-level", "debug"}); }
  static void TearDownTestSuite() { daemon_.reset(); }

  void SetUp() override {
    bytes_before_ = device_bytes();
    ASSERT_TRUE(ok(peer_.put(name_, ball_.scene())));
  }
  void TearDown() override {
    // Work that goes on still holds the scene.
    EXPECT_TRUE(ok(peer_.remove(name_)));
    EXPECT_TRUE(test_support::eventually([&] { return device_bytes() == bytes_before_; }))
        << device_bytes() << " bytes on the device, " << bytes_before_ << " before the work";
    expect_serving(daemon_->address());
    ReceivedMesh mesh;
    EXPECT_TRUE(ok(peer_.mesh(mesh_request(inlined(ball_.scene()), 0.05), &mesh)));
  }

  std::uint64_t device_bytes() { return peer_.info().device_bytes(); }

  // Waits until the call has ended on the server, and returns its line of the log. A connection without traffic may
  // pass a cancellation on seconds later, so other calls keep it busy in the meantime.
  std::string expect_ended(const std::string& method, const std::string& scene) {
    const std::string call = method + " scene=" + scene;
    const auto has_ended = [&] {
      device_bytes();
      return daemon_->process().errors().find(call) != std::string::npos;
    };
    EXPECT_TRUE(test_support::eventually(has_ended)) << call << " goes on:\n" << daemon_->process().errors();
    return daemon_->process().wait_for_error_line(call);
  }
  // Checks, too, that the call was cut off: its work or its writing was stopped, and its answer has no summary, which
  // would give the number of cells.
  void expect_cut_off(const std::string& method, const std::string& scene) {
    const std::string line = expect_ended(method, scene);
    const std::regex cut_off(", (CANCELLED: the request was cancelled|(CANCELLED: )?the client is gone)$");
    EXPECT_TRUE(std::regex_search(line, cut_off)) << "'" << line << "' in:\n" << daemon_->process().errors();
    EXPECT_EQ(line.find(" cells="), std::string::npos) << line;
  }

  static std::unique_ptr<Daemon> daemon_;
  // The scene of each test has a name of its own, which tells its calls from others in the log.
  const std::string name_ = testing::UnitTest::GetInstance()->current_test_info()->name();
  Ball ball_;
  Peer peer_{daemon_->address()};
  std::uint64_t bytes_before_ = 0;
};

std::unique_ptr<Daemon> Cancel::daemon_;

TEST_F(Cancel, OfAMeshStopsTheWork) {
  LimitedContext context;
  const auto stream = peer_.meshes().Mesh(&context, mesh_request(named(name_), kTinyCell));
  v1::MeshResponse response;
  ASSERT_TRUE(stream->Read(&response));
  ASSERT_TRUE(response.has_progress());
  EXPECT_LT(response.progress().fraction(), 1);
  context.TryCancel();
  while (stream->Read(&response)) EXPECT_FALSE(response.has_summary());
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  expect_cut_off("MeshService/Mesh", name_);
}

TEST_F(Cancel, ByTheClientLibraryStopsTheWork) {
  auto client = Client::connect(daemon_->address());
  ASSERT_TRUE(client.ok());
  double seen = -1;
  const auto mesh = client->mesh(mesh_request(named(name_), kTinyCell), [&](const v1::MeshProgress& progress) {
    seen = progress.fraction();
    return false;
  });
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kCancelled);
  EXPECT_GE(seen, 0);
  EXPECT_LT(seen, 1);
  expect_cut_off("MeshService/Mesh", name_);
}

TEST_F(Cancel, ByDeadlineStopsTheWork) {
  ClientOptions options;
  options.stream_timeout = std::chrono::milliseconds(300);
  auto client = Client::connect(daemon_->address(), options);
  ASSERT_TRUE(client.ok());
  const auto mesh = client->mesh(mesh_request(named(name_), kTinyCell));
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kDeadlineExceeded);
  expect_cut_off("MeshService/Mesh", name_);
}

TEST_F(Cancel, ByAKilledClientStopsTheWork) {
  const TemporaryDirectory directory;
  Process command({ISOFIELD_COMMAND, "--server", daemon_->address(), "mesh", name_, "--cell", std::to_string(kTinyCell),
                   "-o", directory.path("ball.glb")});
  const auto has_begun = [&] { return device_bytes() > bytes_before_ + (1 << 20) || !command.is_running(); };
  EXPECT_TRUE(test_support::eventually(has_begun)) << "the work does not begin";
  command.signal(SIGKILL);
  EXPECT_EQ(command.wait(), 128 + SIGKILL);
  expect_cut_off("MeshService/Mesh", name_);
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
  ASSERT_TRUE(ok(peer_.put(name_ + "/balls", scene)));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(250));
  const auto stream = peer_.meshes().Mesh(&context, mesh_request(named(name_ + "/balls"), 0.08));
  v1::MeshResponse response;
  while (stream->Read(&response)) EXPECT_TRUE(response.has_progress());
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  expect_cut_off("MeshService/Mesh", name_ + "/balls");
  EXPECT_TRUE(ok(peer_.remove(name_ + "/balls")));
}

TEST_F(Cancel, OfAStreamOfPointsEndsIt) {
  const std::vector<float> xyz = points_around(ball_, 1, 65'536);
  LimitedContext context;
  const auto stream = peer_.fields().EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = named(name_);
  *request.mutable_points() = points_tensor(std::span(xyz));
  ASSERT_TRUE(stream->Write(request));
  // The answers to two more parts do not fit in what gRPC keeps for a client that does not read.
  request.clear_scene();
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(stream->Write(request));
  v1::EvaluateResponse response;
  ASSERT_TRUE(stream->Read(&response));
  context.TryCancel();
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  expect_cut_off("FieldService/EvaluateStream", name_);
}

TEST_F(Cancel, OfAGridEndsIt) {
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = named(name_);
  for (int a = 0; a < 3; ++a) {
    request.add_origin(-2);
    request.add_spacing(0.004);
    request.add_counts(1000);
  }
  LimitedContext context;
  const auto stream = peer_.fields().EvaluateGrid(&context, request);
  v1::EvaluateGridResponse response;
  ASSERT_TRUE(stream->Read(&response));
  context.TryCancel();
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  expect_cut_off("FieldService/EvaluateGrid", name_);
}

}  // namespace
}  // namespace isofield::integration_test
