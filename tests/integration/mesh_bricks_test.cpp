// Tests meshes by bricks over gRPC: parts that join to the whole, and meshes that follow the edits of their scene.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>
#include <isofield/client.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/eventually.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

// In the process that is to die, this variable holds the address at which MeshBricksClient tracks meshes.
constexpr char kServerVariable[] = "ISOFIELD_TRACKED_SERVER";

v1::ParameterEdit edit_of(const std::string& node, const std::string& field, const std::vector<double>& values) {
  v1::ParameterEdit edit;
  edit.set_node(node);
  edit.set_field(field);
  edit.mutable_values()->Add(values.begin(), values.end());
  return edit;
}

// Makes a blend of spheres that lie densely in [-1, 1]^3.
v1::Scene balls(int count) {
  test_support::Random random(7);
  v1::Scene scene;
  v1::Node root;
  for (int i = 0; i < count; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-1, 1));
    s->set_radius(random.number(0.1, 0.2));
    s->set_range(0.15);
    root.mutable_gradient()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = root;
  return scene;
}

// Compares the meshes bit for bit.
void expect_same(const BrickMesh& bricks, const ReceivedMesh& mesh) {
  const auto joined = bricks.join();
  ASSERT_TRUE(joined.ok()) << joined.status();
  EXPECT_TRUE(joined->positions == mesh.positions);
  EXPECT_TRUE(joined->normals == mesh.normals);
  EXPECT_TRUE(joined->triangles == mesh.triangles);
}

class MeshBricks : public testing::Test {
 protected:
  // Sends these messages in one stream and returns the status that ends it.
  grpc::Status track(const std::vector<v1::TrackMeshRequest>& requests) {
    LimitedContext context;
    const auto stream = peer_.meshes().TrackMesh(&context);
    for (const v1::TrackMeshRequest& request : requests) {
      if (!stream->Write(request)) break;
    }
    stream->WritesDone();
    v1::TrackMeshResponse response;
    while (stream->Read(&response)) {
    }
    return stream->Finish();
  }
  static v1::TrackMeshRequest begin_of(const v1::SceneRef& scene) {
    v1::TrackMeshRequest request;
    *request.mutable_begin() = mesh_request(scene, 0.1);
    return request;
  }

  Peer peer_{shared_daemon().address()};
  Client client_ = Client::connect(shared_daemon().address()).value();
};

TEST_F(MeshBricks, WholeAndInEightPartsAreTheMesh) {
  for (const std::uint64_t seed : {3, 8, 13}) {
    v1::MeshBricksRequest request;
    const v1::Scene scene = test_support::random_scene(seed, {.nodes = 60, .all_operators = seed == 13});
    *request.mutable_mesh() = mesh_request(inlined(scene), 0.05);
    for (int a = 0; a < 3; ++a) {
      request.mutable_mesh()->add_bounds_min(-1.5 - 0.1 * a);
      request.mutable_mesh()->add_bounds_max(1.5);
    }
    request.mutable_mesh()->set_omit_normals(seed == 8);
    const ReceivedMesh expected = peer_.mesh(request.mesh());
    ASSERT_FALSE(expected.triangles.empty()) << "seed " << seed;
    const auto whole = client_.mesh_bricks(request);
    ASSERT_TRUE(whole.ok()) << whole.status();
    expect_same(whole->bricks, expected);
    EXPECT_EQ(whole->summary.vertices(), expected.summary.vertices());
    EXPECT_EQ(whole->summary.triangles(), expected.summary.triangles());

    ASSERT_EQ(whole->summary.lattice_bricks_size(), 3);
    BrickMesh stitched;
    std::size_t bricks = 0;
    for (int octant = 0; octant < 8; ++octant) {
      request.clear_first_brick();
      request.clear_brick_counts();
      for (int a = 0; a < 3; ++a) {
        const std::uint32_t count = whole->summary.lattice_bricks(a), middle = count / 2;
        const bool upper = octant >> a & 1;
        request.add_first_brick(upper ? middle : 0);
        request.add_brick_counts(upper ? count - middle : middle);
      }
      const auto part = client_.mesh_bricks(request);
      ASSERT_TRUE(part.ok()) << part.status();
      EXPECT_LT(part->bricks.brick_count(), whole->bricks.brick_count());
      bricks += part->bricks.brick_count();
      stitched.add(part->bricks);
    }
    EXPECT_EQ(bricks, whole->bricks.brick_count()) << "a brick of two parts";
    expect_same(stitched, expected);
  }
}

TEST_F(MeshBricks, PartsThatAreNoneAreRefused) {
  v1::MeshBricksRequest request;
  *request.mutable_mesh() = mesh_request(inlined(Ball().scene()), 0.1);
  for (const std::uint32_t i : {0, 1, 2}) request.add_first_brick(i);
  auto refused = client_.mesh_bricks(request).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused.message().find("brick_counts hold 3 and 0"), std::string::npos) << refused;
  for (const std::uint32_t n : {4, 0, 4}) request.add_brick_counts(n);
  refused = client_.mesh_bricks(request).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused.message().find("brick_counts[1] = 0"), std::string::npos) << refused;
  v1::MeshBricksRequest simplified;
  *simplified.mutable_mesh() = mesh_request(inlined(Ball().scene()), 0.1);
  simplified.mutable_mesh()->set_simplification_error(0.1);
  refused = client_.mesh_bricks(simplified).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused.message().find("simplification_error = 0.1: expected none"), std::string::npos) << refused;
  simplified.mutable_mesh()->clear_simplification_error();
  simplified.mutable_mesh()->set_crease_normals(true);
  refused = client_.mesh_bricks(simplified).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused.message().find("crease_normals = true: expected none"), std::string::npos) << refused;
  *request.mutable_mesh()->mutable_scene() = named("none");
  EXPECT_EQ(client_.mesh_bricks(request).status().code(), absl::StatusCode::kNotFound);
}

TEST_F(MeshBricks, ProgressCanCancelThem) {
  v1::MeshBricksRequest request;
  *request.mutable_mesh() = mesh_request(inlined(Ball().scene()), 0.0022);
  const std::uint64_t bytes_before = peer_.info().device_bytes();
  EXPECT_EQ(client_.mesh_bricks(request, [](const v1::MeshProgress&) { return false; }).status().code(),
            absl::StatusCode::kCancelled);
  EXPECT_TRUE(test_support::eventually([&] { return peer_.info().device_bytes() <= bytes_before; }))
      << peer_.info().device_bytes() << " bytes on the device, " << bytes_before << " before the work";
}

TEST_F(MeshBricks, ATrackedMeshFollowsEdits) {
  ASSERT_TRUE(ok(peer_.put("tracked", balls(60))));
  const v1::MeshRequest request = mesh_request(named("tracked"), 0.05);
  auto tracked = client_.track_mesh(request);
  ASSERT_TRUE(tracked.ok()) << tracked.status();
  EXPECT_TRUE(tracked->changes().is_whole);
  EXPECT_EQ(tracked->changes().bricks_put, tracked->bricks().brick_count());
  EXPECT_EQ(tracked->changes().bricks_removed, 0u);
  expect_same(tracked->bricks(), peer_.mesh(request));

  const std::vector<std::vector<v1::ParameterEdit>> steps{
      {edit_of("#3", "center", {0.1, 0.2, 0.3})},
      {edit_of("#4", "radius", {0.3}), edit_of("#5", "range", {0.1})},
      {edit_of("#6", "center.x", {1.4})},  // over the edge of the lattice, perhaps
      {edit_of("#6", "center.x", {0})},
      {edit_of("#7", "radius", {0.01})},
      {},
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SCOPED_TRACE(absl::StrCat("edit ", i));
    const std::size_t before = tracked->bricks().brick_count();
    const auto summary = tracked->edit(steps[i]);
    ASSERT_TRUE(summary.ok()) << summary.status();
    const ReceivedMesh fresh = peer_.mesh(request);
    expect_same(tracked->bricks(), fresh);
    EXPECT_EQ(summary->scene_version(), fresh.summary.scene_version());
    EXPECT_EQ(summary->vertices(), fresh.summary.vertices());
    const MeshChanges& changes = tracked->changes();
    EXPECT_LE(tracked->bricks().brick_count(), before - changes.bricks_removed + changes.bricks_put);
    std::cout << "edit " << i << ": " << changes.bricks_put << " put, " << changes.bricks_removed << " removed of "
              << before << (changes.is_whole ? ", whole\n" : "\n");
  }
  EXPECT_TRUE(ok(peer_.remove("tracked")));
}

TEST_F(MeshBricks, ATrackedMeshFollowsOthers) {
  ASSERT_TRUE(ok(peer_.put("tracked", balls(40))));
  const v1::MeshRequest request = mesh_request(named("tracked"), 0.05);
  auto tracked = client_.track_mesh(request);
  ASSERT_TRUE(tracked.ok()) << tracked.status();

  v1::EditParametersRequest edit;
  edit.set_name("tracked");
  for (const double x : {-0.5, 0.0, 0.5}) {
    edit.clear_edits();
    *edit.add_edits() = edit_of("#3", "center.y", {x});
    ASSERT_TRUE(ok(peer_.edit(edit)));
  }
  ASSERT_TRUE(tracked->refresh().ok());
  EXPECT_FALSE(tracked->changes().is_whole);
  EXPECT_GT(tracked->changes().bricks_put, 0u);
  expect_same(tracked->bricks(), peer_.mesh(request));

  ASSERT_TRUE(tracked->refresh().ok());
  EXPECT_EQ(tracked->changes().bricks_put + tracked->changes().bricks_removed, 0u);
  expect_same(tracked->bricks(), peer_.mesh(request));

  // One answer holds another client's edit and one's own.
  edit.clear_edits();
  *edit.add_edits() = edit_of("#8", "radius", {0.25});
  ASSERT_TRUE(ok(peer_.edit(edit)));
  ASSERT_TRUE(tracked->edit({edit_of("#9", "radius", {0.25})}).ok());
  expect_same(tracked->bricks(), peer_.mesh(request));

  // The name now belongs to another scene.
  ASSERT_TRUE(ok(peer_.put("tracked", Ball().scene())));
  ASSERT_TRUE(tracked->refresh().ok());
  expect_same(tracked->bricks(), peer_.mesh(request));

  // A scene that is gone ends the stream, and the status stays.
  EXPECT_TRUE(ok(peer_.remove("tracked")));
  EXPECT_EQ(tracked->refresh().status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(tracked->refresh().status().code(), absl::StatusCode::kNotFound);
}

TEST_F(MeshBricks, AMovedPrimitiveSendsAFewBricks) {
  ASSERT_TRUE(ok(peer_.put("many", balls(200))));
  auto tracked = client_.track_mesh(mesh_request(named("many"), 0.03));
  ASSERT_TRUE(tracked.ok()) << tracked.status();
  const std::size_t all = tracked->bricks().brick_count();
  v1::GetSceneResponse scene;
  ASSERT_TRUE(ok(peer_.get("many", &scene)));
  for (const int i : {17, 90, 141}) {
    const double x = scene.scene().nodes(i).sphere().center(0);
    ASSERT_TRUE(tracked->edit({edit_of(test_support::place(i), "center.x", {x > 0 ? x - 0.1 : x + 0.1})}).ok());
    const MeshChanges& changes = tracked->changes();
    EXPECT_FALSE(changes.is_whole);
    EXPECT_GT(changes.bricks_put, 0u);
    EXPECT_LT(3 * (changes.bricks_put + changes.bricks_removed), all);
    std::cout << changes.bricks_put << " bricks put and " << changes.bricks_removed << " removed of " << all << "\n";
  }
  expect_same(tracked->bricks(), peer_.mesh(mesh_request(named("many"), 0.03)));
  EXPECT_TRUE(ok(peer_.remove("many")));
}

TEST_F(MeshBricks, WhatIsWrongWithAStreamIsSaid) {
  ASSERT_TRUE(ok(peer_.put("ball", Ball().scene())));
  v1::TrackMeshRequest edit, refresh;
  *edit.mutable_edit()->add_edits() = edit_of("#0", "radius", {0.5});
  refresh.mutable_refresh();
  expect_refused(track({edit}), StatusCode::INVALID_ARGUMENT, {"first message", "begin"});
  expect_refused(track({refresh}), StatusCode::INVALID_ARGUMENT, {"first message", "begin"});
  expect_refused(track({v1::TrackMeshRequest()}), StatusCode::INVALID_ARGUMENT, {"first message", "begin"});
  expect_refused(track({begin_of(inlined(Ball().scene()))}), StatusCode::INVALID_ARGUMENT, {"begin.scene", "name"});
  expect_refused(track({begin_of(named("none"))}), StatusCode::NOT_FOUND, {"none"});
  v1::TrackMeshRequest simplified = begin_of(named("ball"));
  simplified.mutable_begin()->set_simplification_error(0.1);
  expect_refused(track({simplified}), StatusCode::INVALID_ARGUMENT, {"simplification_error = 0.1", "none", "bricks"});
  const v1::TrackMeshRequest begin = begin_of(named("ball"));
  expect_refused(track({begin, begin}), StatusCode::INVALID_ARGUMENT, {"edit or refresh"});
  edit.mutable_edit()->mutable_edits(0)->set_field("girth");
  expect_refused(track({begin, edit}), StatusCode::INVALID_ARGUMENT, {"girth"});
  edit.mutable_edit()->mutable_edits(0)->set_field("radius");
  edit.mutable_edit()->set_name("cube");
  expect_refused(track({begin, edit}), StatusCode::INVALID_ARGUMENT, {"edit.name = 'cube'", "'ball'"});
  edit.mutable_edit()->set_name("ball");
  edit.mutable_edit()->set_expected_version(1'000'000'000);
  expect_refused(track({begin, edit}), StatusCode::ABORTED, {});
  edit.mutable_edit()->set_expected_version(0);
  EXPECT_TRUE(ok(track({begin, edit, refresh})));
  EXPECT_TRUE(ok(track({})));

  // In the client library, a refused edit ends the stream, and the edit before it stays.
  auto tracked = client_.track_mesh(begin.begin());
  ASSERT_TRUE(tracked.ok()) << tracked.status();
  ASSERT_TRUE(tracked->edit({edit_of("#0", "radius", {0.75})}).ok());
  const auto refused = tracked->edit({edit_of("#0", "radius", {-1})}).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused.message().find("radius = -1"), std::string::npos) << refused;
  EXPECT_EQ(tracked->refresh().status(), refused);
  v1::GetSceneResponse scene;
  ASSERT_TRUE(ok(peer_.get("ball", &scene)));
  EXPECT_EQ(scene.scene().nodes(0).sphere().radius(), 0.75);
  EXPECT_TRUE(ok(peer_.remove("ball")));
}

// The daemon admits two tracked meshes.
class MeshBricksLimit : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(client_.put_scene("ball", Ball().scene()).ok()); }
  void TearDown() override {
    expect_both_free();
    expect_serving(daemon_.address());
  }
  // The daemon takes some time to notice that a client has gone.
  void expect_both_free() {
    absl::Status status;
    EXPECT_TRUE(test_support::eventually([&] {
      auto first = client_.track_mesh(request_), second = client_.track_mesh(request_);
      status = first.status();
      status.Update(second.status());
      return status.ok();
    })) << status;
  }

  Daemon daemon_{{"--max-threads", "16", "--log-level", "debug"}};
  Client client_ = Client::connect(daemon_.address()).value();
  const v1::MeshRequest request_ = mesh_request(named("ball"), 0.1);
};

TEST_F(MeshBricksLimit, OneTooManyIsRefused) {
  auto first = client_.track_mesh(request_), second = client_.track_mesh(request_);
  ASSERT_TRUE(first.ok() && second.ok());
  const auto third = client_.track_mesh(request_).status();
  EXPECT_EQ(third.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_NE(third.message().find("--max-threads"), std::string::npos) << third;
  EXPECT_TRUE(first->refresh().ok());
}

TEST_F(MeshBricksLimit, CancelledStreamsAreFree) {
  for (int i = 0; i < 10; ++i) {
    expect_both_free();
    // The streams of expect_both_free() end a moment later than that returns.
    absl::StatusOr<TrackedMesh> tracked = absl::UnknownError("not tried yet");
    ASSERT_TRUE(test_support::eventually([&] {
      tracked = client_.track_mesh(request_);
      return tracked.ok();
    })) << tracked.status();
    tracked->cancel();
    EXPECT_EQ(tracked->refresh().status().code(), absl::StatusCode::kCancelled);
  }
}

TEST_F(MeshBricksLimit, AStreamCancelledWhileItsMeshIsMadeIsFree) {
  Peer peer(daemon_.address());
  const std::uint64_t bytes_before = peer.info().device_bytes();
  LimitedContext context;
  const auto stream = peer.meshes().TrackMesh(&context);
  v1::TrackMeshRequest begin;
  // The mesh has nearly as many cells as are admitted, which is some seconds of work.
  *begin.mutable_begin() = mesh_request(named("ball"), 0.0022);
  ASSERT_TRUE(stream->Write(begin));
  const auto has_begun = [&] {
    return !daemon_.is_running() || peer.info().device_bytes() >= bytes_before + (1 << 20);
  };
  EXPECT_TRUE(test_support::eventually(has_begun)) << "the work does not begin";
  context.TryCancel();
  EXPECT_EQ(stream->Finish().error_code(), StatusCode::CANCELLED);
  // The log's line of the call is written when the server has ended its work. It tells whether the work was cancelled,
  // or whether a finished mesh could not be sent.
  const std::string line = daemon_.process().wait_for_error_line("MeshService/TrackMesh");
  EXPECT_NE(line.find("CANCELLED: the request was cancelled"), std::string::npos) << daemon_.process().errors();
}

TEST_F(MeshBricksLimit, TheStreamsOfAKilledClientAreFree) {
  Process client({"/usr/bin/env", absl::StrCat(kServerVariable, "=", daemon_.address()),
                  std::filesystem::read_symlink("/proc/self/exe").string(), "--gtest_also_run_disabled_tests",
                  "--gtest_filter=MeshBricksClient.DISABLED_TracksUntilItIsKilled"});
  ASSERT_NE(client.wait_for_error_line("tracking"), "") << client.output();
  client.signal(SIGKILL);
  EXPECT_EQ(client.wait(), 128 + SIGKILL);
}

// This is not a test but another process. It holds two tracked meshes and waits for its end.
TEST(MeshBricksClient, DISABLED_TracksUntilItIsKilled) {
  const char* const server = std::getenv(kServerVariable);
  if (!server) GTEST_SKIP() << "started by MeshBricksLimit.TheStreamsOfAKilledClientAreFree";
  Client client = Client::connect(server).value();
  const auto first = client.track_mesh(mesh_request(named("ball"), 0.1));
  const auto second = client.track_mesh(mesh_request(named("ball"), 0.1));
  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(second.ok()) << second.status();
  std::cerr << "tracking\n";
  pause();
}

}  // namespace
}  // namespace isofield::integration_test
