// Tests that the log has a line for each call with --log-level debug.
#include <gtest/gtest.h>
#include <isofield/client.h>

#include <regex>
#include <string>
#include <vector>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {
namespace {

const std::string kTimes =
    R"(: queue (\d+\.\d) ms, kernels (\d+\.\d) ms, device (\d+\.\d) ms, transfer (\d+\.\d) ms, total (\d+\.\d) ms, )";

// Checks that exactly `count` lines of the log are about a call that matches `pattern`.
void expect_calls(const std::string& log, const std::string& pattern, std::ptrdiff_t count = 1) {
  const std::regex line("debug call \\d+ " + pattern);
  EXPECT_EQ(std::distance(std::sregex_iterator(log.begin(), log.end(), line), {}), count) << pattern << " in\n" << log;
}

TEST(CallLog, HasALineForEachCallOfTheDebugLevel) {
  Daemon daemon({"--log-level", "debug"});
  {
    Peer peer(daemon.address());
    const Ball ball;
    ASSERT_TRUE(ok(peer.put("ball", ball.scene())));
    std::vector<float> out;
    ASSERT_TRUE(ok(peer.evaluate(named("ball"), points_around(ball, 0, 64), true, &out)));
    ASSERT_TRUE(ok(peer.evaluate(inlined(ball.scene()), points_around(ball, 0, 5), false, &out)));
    v1::EvaluateStreamRequest first, second;
    *first.mutable_scene() = named("ball");
    *first.mutable_points() = points_tensor(std::span<const float>(points_around(ball, 0, 7)));
    *second.mutable_points() = points_tensor(std::span<const float>(points_around(ball, 0, 9)));
    std::vector<v1::EvaluateResponse> answers;
    ASSERT_TRUE(ok(peer.evaluate_stream({first, second}, &answers)));
    EXPECT_GT(peer.mesh(mesh_request(named("ball"), 0.1)).triangles.size(), 0u);
    v1::EvaluateGridRequest grid;
    *grid.mutable_scene() = named("ball");
    for (const double x : {0.0, 0.0, 0.0}) grid.add_origin(x);
    grid.add_spacing(0.1);
    for (const std::uint64_t count : {3, 4, 5}) grid.add_counts(count);
    ASSERT_TRUE(ok(peer.evaluate_grid(grid, &out)));
    ASSERT_TRUE(Client::connect(daemon.address())->track_mesh(mesh_request(named("ball"), 0.1)).ok());
    EXPECT_EQ(peer.evaluate(named("none\nof\x1b[31mthese"), points_around(ball, 0, 1), false, &out).error_code(),
              grpc::StatusCode::NOT_FOUND);
    v1::GetOperatorRequest request;
    request.set_name("gradient");
    v1::GetOperatorResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(ok(peer.operators().GetOperator(&context, request, &response)));
  }
  daemon.stop();
  const std::string log = daemon.process().errors();
  expect_calls(log, "SceneService/PutScene scene=ball" + kTimes + "OK\n");
  expect_calls(log, "FieldService/Evaluate scene=ball points=64" + kTimes + "OK\n");
  expect_calls(log, R"(FieldService/Evaluate scene=\(inline\) points=5)" + kTimes + "OK\n");
  expect_calls(log, "FieldService/EvaluateStream scene=ball points=16" + kTimes + "OK\n");
  expect_calls(log, "MeshService/Mesh scene=ball cells=[1-9]\\d*" + kTimes + "OK\n");
  expect_calls(log, "OperatorService/GetOperator operator=gradient" + kTimes + "OK\n");
  expect_calls(log, "FieldService/EvaluateGrid scene=ball points=60" + kTimes + "OK\n");
  expect_calls(log, "MeshService/TrackMesh" + kTimes + "[^\n]*\n");
  // A call has one line, whatever characters the name holds.
  expect_calls(log, R"(FieldService/Evaluate scene=none\?of\?\[31mthese)" + kTimes + "NOT_FOUND: [^\n]*\n");
  // The mesh is the first to need its kernels, so it has waited for them, and the device has worked for it.
  std::smatch mesh;
  ASSERT_TRUE(std::regex_search(log, mesh, std::regex("MeshService/Mesh[^:]*" + kTimes)));
  EXPECT_GT(std::stod(mesh[2]), 0.0);
  EXPECT_GT(std::stod(mesh[3]), 0.0);
  EXPECT_LE(std::stod(mesh[2]) + std::stod(mesh[3]), std::stod(mesh[5]));
}

TEST(CallLog, IsNotWrittenOtherwise) {
  Daemon daemon;
  std::vector<float> out;
  ASSERT_TRUE(ok(Peer(daemon.address()).put("ball", Ball().scene())));
  daemon.stop();
  EXPECT_EQ(daemon.process().errors().find("PutScene"), std::string::npos);
}

}  // namespace
}  // namespace isofield::integration_test
