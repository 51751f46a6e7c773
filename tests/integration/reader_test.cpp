// Tests scenes that change or go while they are read, and many clients at once.
#include <gtest/gtest.h>
#include <isofield/client.h>

#include <cstring>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/mesh_check.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr double kValueError = 2e-5;

// An EvaluateStream that is held open between its chunks.
class OpenStream {
 public:
  OpenStream(Peer& peer, const std::string& scene) : stream_(peer.fields().EvaluateStream(&context_)) {
    *request_.mutable_scene() = named(scene);
  }
  // Evaluates some points, and returns the error of the answer by the formula of `ball`.
  double error_at_points_around(const Ball& ball) {
    const std::vector<float> xyz = points_around(ball, 1, 1000);
    *request_.mutable_points() = points_tensor(std::span(xyz));
    v1::EvaluateResponse response;
    EXPECT_TRUE(stream_->Write(request_));
    EXPECT_TRUE(stream_->Read(&response));
    request_.clear_scene();
    return ball.errors(xyz, floats_of(response.result())).value;
  }
  grpc::Status finish() {
    stream_->WritesDone();
    return stream_->Finish();
  }

 private:
  LimitedContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::EvaluateStreamRequest, v1::EvaluateResponse>> stream_;
  v1::EvaluateStreamRequest request_;
};

class Reader : public testing::Test {
 protected:
  void TearDown() override {
    for (const v1::SceneSummary& summary : other_.list()) EXPECT_TRUE(ok(other_.remove(summary.name())));
    EXPECT_EQ(other_.info().device_bytes(), device_bytes_) << "a scene outlives its last reader";
  }

  Ball ball_;
  Peer peer_{shared_daemon().address()}, other_{shared_daemon().address()};
  const std::uint64_t device_bytes_ = peer_.info().device_bytes();
};

TEST_F(Reader, OfADeletedSceneFinishesOnIt) {
  ASSERT_TRUE(ok(other_.put("ball", ball_.scene())));
  OpenStream stream(peer_, "ball");
  EXPECT_LE(stream.error_at_points_around(ball_), kValueError);
  ASSERT_TRUE(ok(other_.remove("ball")));
  EXPECT_TRUE(other_.list().empty());
  expect_refused(other_.evaluate(named("ball"), {}, false, nullptr), StatusCode::NOT_FOUND, {"ball"});
  EXPECT_LE(stream.error_at_points_around(ball_), kValueError);
  EXPECT_TRUE(ok(stream.finish()));
}

TEST_F(Reader, OfAReplacedSceneFinishesOnTheOldOne) {
  Ball larger;
  larger.radius = 2;
  ASSERT_TRUE(ok(other_.put("ball", ball_.scene())));
  OpenStream stream(peer_, "ball");
  EXPECT_LE(stream.error_at_points_around(ball_), kValueError);
  ASSERT_TRUE(ok(other_.put("ball", larger.scene())));
  EXPECT_LE(stream.error_at_points_around(ball_), kValueError);
  OpenStream second(other_, "ball");
  EXPECT_LE(second.error_at_points_around(larger), kValueError);
  v1::EditParametersRequest edit;
  edit.set_name("ball");
  edit.add_edits()->set_node("ball");
  edit.mutable_edits(0)->set_field("radius");
  edit.mutable_edits(0)->add_values(3);
  ASSERT_TRUE(ok(other_.edit(edit)));
  EXPECT_LE(second.error_at_points_around(larger), kValueError);
  EXPECT_LE(stream.error_at_points_around(ball_), kValueError);
  EXPECT_TRUE(ok(stream.finish()));
  EXPECT_TRUE(ok(second.finish()));
}

TEST_F(Reader, WhoMeshesADeletedSceneGetsItsMesh) {
  for (const bool replaced : {false, true}) {
    ASSERT_TRUE(ok(other_.put("ball", ball_.scene())));
    const double cell = 0.006;
    LimitedContext context;
    const auto stream = peer_.meshes().Mesh(&context, mesh_request(named("ball"), cell));
    v1::MeshResponse response;
    // The first sign of life shows that the scene is leased.
    ASSERT_TRUE(stream->Read(&response));
    Ball larger;
    larger.radius = 2;
    ASSERT_TRUE(ok(replaced ? other_.put("ball", larger.scene()) : other_.remove("ball")));
    std::string positions;
    do {
      if (response.has_part()) positions += response.part().positions().data();
    } while (stream->Read(&response));
    ASSERT_TRUE(ok(stream->Finish()));
    ReceivedMesh expected;
    ASSERT_TRUE(ok(other_.mesh(mesh_request(inlined(ball_.scene()), cell), &expected)));
    ASSERT_EQ(positions.size(), 4 * expected.positions.size());
    EXPECT_EQ(std::memcmp(positions.data(), expected.positions.data(), positions.size()), 0);
  }
}

TEST_F(Reader, ManyClientsWithMixedCallsAreAllServed) {
  constexpr int kClients = 32, kRounds = 6;
  const v1::Scene blend = test_support::scene_of_nodes(R"(
    {"name": "a", "sphere": {"center": [-0.5, 0, 0], "radius": 0.6, "range": 0.4}},
    {"name": "b", "sphere": {"center": [0.5, 0, 0], "radius": 0.5, "range": 0.4}},
    {"gradient": {"children": ["a", "b"]}})");
  ReceivedMesh expected;
  ASSERT_TRUE(ok(other_.mesh(mesh_request(inlined(blend), 0.05), &expected)));
  const auto client_of = [&](int number) {
    Peer peer(shared_daemon().address());
    Ball ball;
    ball.radius = 0.5 + 0.05 * number;
    const std::string own = "own/" + std::to_string(number);
    for (int round = 0; round < kRounds; ++round) {
      switch ((number + round) % 4) {
        case 0: {
          // All of these clients write the same scene.
          EXPECT_TRUE(ok(peer.put("common", blend)));
          ReceivedMesh mesh;
          EXPECT_TRUE(ok(peer.mesh(mesh_request(named("common"), 0.05), &mesh)));
          EXPECT_EQ(mesh.triangles, expected.triangles);
          EXPECT_EQ(mesh.positions, expected.positions);
          break;
        }
        case 1: {
          const std::vector<float> xyz = points_around(ball, round, 5000);
          std::vector<float> results;
          EXPECT_TRUE(ok(peer.put(own, ball.scene())));
          EXPECT_TRUE(ok(peer.evaluate(named(own), xyz, true, &results)));
          EXPECT_LE(ball.errors(xyz, results).value, kValueError);
          EXPECT_TRUE(ok(peer.remove(own)));
          break;
        }
        case 2: {
          EXPECT_TRUE(ok(peer.put("common", blend)));
          v1::EditParametersRequest edit;
          edit.set_name("common");
          edit.add_edits()->set_node("a");
          edit.mutable_edits(0)->set_field("radius");
          edit.mutable_edits(0)->add_values(0.6);
          // With so many writers at once an edit may lose every race, and its status says so.
          const grpc::Status status = peer.edit(edit);
          EXPECT_TRUE(status.ok() || status.error_code() == StatusCode::ABORTED) << status.error_message();
          break;
        }
        default:
          peer.list();
          peer.info();
          expect_refused(peer.evaluate(named("nothing"), {}, false, nullptr), StatusCode::NOT_FOUND, {"nothing"});
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < kClients; ++i) threads.emplace_back(client_of, i);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(other_.info().resident_scenes(), other_.list().size()) << "replaced versions stay on the device";
}

TEST_F(Reader, WritersOfOneNameLeaveOneSceneOnTheDevice) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([this] {
      Peer peer(shared_daemon().address());
      for (int round = 0; round < 100; ++round) EXPECT_TRUE(ok(peer.put("ball", ball_.scene())));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(other_.info().resident_scenes(), 1u);
}

}  // namespace
}  // namespace isofield::integration_test
