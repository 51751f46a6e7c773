// Tests SurfaceService and Measure over gRPC: by the stubs, the client and the command line.
#include <gtest/gtest.h>
#include <isofield/client.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "integration/process.h"
#include "integration/temporary_directory.h"
#include "isofield/v1/surface_service.grpc.pb.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

Client client() {
  return Client::connect(shared_daemon().address()).value();
}

v1::Scene two_balls() {
  return test_support::scene_of_nodes(R"([
    {"name": "left", "sphere": {"center": [-2, 0, 0], "radius": 1, "range": 0.5}},
    {"sphere": {"center": [2, 0, 0], "radius": 1, "range": 0.5}},
    {"max": {"children": ["left", "#1"]}}])");
}

// The operators are nested so that points far from the balls may be inside.
constexpr char kUnbounded[] = R"([
    {"name": "a", "sphere": {"radius": 1, "law": "SIGNED"}}, {"name": "b", "sphere": {"radius": 2, "law": "SIGNED"}},
    {"name": "both", "superelliptic": {"children": ["a", "b"], "exponent": 2, "ranges": [1]}},
    {"pasko": {"children": ["both", "a"], "a0": -5, "a1": 1, "a2": 1}}])";

TEST(Surface, RaysHitBallsAndNameThem) {
  Client c = client();
  v1::CastRaysRequest request;
  *request.mutable_scene() = inline_scene(two_balls());
  // There are more rays than one message holds, and later messages name the nodes in another order.
  const std::size_t count = Client::kChunkPoints + 3;
  std::vector<float> origins, directions;
  for (std::size_t i = 0; i < count; ++i) {
    const bool right = i + 3 >= count;
    origins.insert(origins.end(), {right ? 2.0f : -2.0f, 0, i == 1 ? 0.0f : 4.0f});
    directions.insert(directions.end(), {0, 0, i == 2 ? 1.0f : -1.0f});
  }
  const auto hits = c.cast_rays(request, origins, directions);
  ASSERT_TRUE(hits.ok()) << hits.status();
  ASSERT_EQ(hits->distances.size(), count);
  EXPECT_EQ(hits->names, (std::vector<std::string>{"left", "#1"}));
  EXPECT_NEAR(hits->distances[0], 3, 1e-5);
  EXPECT_EQ(hits->nodes[0], 0u);
  EXPECT_NEAR(hits->distances[1], 1, 1e-5);
  EXPECT_EQ(hits->inside[1], 1);
  EXPECT_TRUE(std::isinf(hits->distances[2]));
  EXPECT_EQ(hits->nodes[2], RayHits::kNothing);
  EXPECT_NEAR(hits->distances[count - 1], 3, 1e-5);
  EXPECT_EQ(hits->nodes[count - 1], 1u);
  EXPECT_NEAR(hits->normals[2], 1, 1e-5);
  EXPECT_GT(hits->cell_size, 0);
}

TEST(Surface, PointsAreProjectedAndTold) {
  Client c = client();
  const std::vector<float> points{-2, 0, 1.25f, -2, 0.75f, 0, 2, -1.4f, 0, 9, 9, 9};
  v1::ProjectPointsRequest request;
  *request.mutable_scene() = inline_scene(two_balls());
  const auto found = c.project(request, points);
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_EQ(found->converged, (std::vector<std::uint8_t>{1, 1, 1, 0}));
  EXPECT_NEAR(found->positions[2], 1, 1e-4);
  EXPECT_NEAR(found->positions[4], 1, 1e-4);
  EXPECT_NEAR(found->positions[7], -1, 1e-4);
  EXPECT_TRUE(std::isinf(found->residuals[3]));
  v1::ContainsRequest contains;
  *contains.mutable_scene() = inline_scene(two_balls());
  const auto inside = c.contains(contains, points);
  ASSERT_TRUE(inside.ok()) << inside.status();
  EXPECT_EQ(*inside, (std::vector<std::uint8_t>{0, 1, 0, 0}));
}

TEST(Surface, SlicesAreTheSameAsTheirPoints) {
  Client c = client();
  const v1::SceneRef scene = inline_scene(test_support::random_scene(8, {.nodes = 60}));
  v1::SliceRequest request;
  *request.mutable_scene() = scene;
  for (const double x : {-2.0, 0.25, -2.0}) request.add_origin(x);
  for (const double x : {3.0, 0.0, 0.0}) request.add_u(x);
  for (const double x : {1.0, 0.0, 0.5}) request.add_v(x);  // its part along u is left out
  request.add_spacing(0.0625);
  request.add_counts(65);
  request.add_counts(50);
  const auto slice = c.slice(request);
  ASSERT_TRUE(slice.ok()) << slice.status();
  std::vector<float> xyz;
  for (int n = 0; n < 65 * 50; ++n) {
    xyz.insert(xyz.end(),
               {-2 + 0.0625f * static_cast<float>(n % 65), 0.25f, -2 + 0.0625f * static_cast<float>(n / 65)});
  }
  const auto values = c.evaluate(scene, xyz, false);
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(std::memcmp(values->data(), slice->values.data(), 4 * values->size()), 0);
  EXPECT_EQ(slice->v, (std::array<double, 3>{0, 0, 1}));
  ASSERT_EQ(slice->curves.size(), 1u);
}

TEST(Surface, ASliceSpansTheSupportsByDefault) {
  Client c = client();
  // The box of its support is [-2, 2] x [-3, 1] x [-1, 7].
  v1::SliceRequest request;
  *request.mutable_scene() = inline_scene(
      test_support::scene_of_nodes(R"({"ellipsoid": {"center": [0, -1, 3], "semi_axes": [1, 1, 2], "range": 1}})"));
  auto slice = c.slice(request);
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_EQ(slice->counts, (std::array<std::uint64_t, 2>{512, 512}));
  EXPECT_NEAR(slice->origin[0], -2, 1e-4);
  EXPECT_NEAR(slice->origin[1], -3, 1e-4);
  EXPECT_NEAR(slice->origin[2], 3, 1e-6);
  EXPECT_NEAR(slice->spacing[0], 4.0 / 511, 1e-6);
  EXPECT_EQ(slice->values.size(), 512u * 512);
  EXPECT_GT(*std::max_element(slice->values.begin(), slice->values.end()), 0.9) << "through the middle";

  // The plane goes through the long axis; either the counts or the spacing are stated.
  for (const double x : {0, 1, 0}) request.add_u(x);
  for (const double x : {0, 0, 1}) request.add_v(x);
  slice = c.slice(request);
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_EQ(slice->counts[1], 512u);
  EXPECT_LT(slice->counts[0], 512u);
  request.add_counts(11);
  request.add_counts(5);
  slice = c.slice(request);
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_NEAR(slice->spacing[0], 0.4, 1e-6);
  request.clear_counts();
  request.add_spacing(0.5);
  slice = c.slice(request);
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_EQ(slice->counts[0], 9u);

  v1::SliceRequest unbounded;
  *unbounded.mutable_scene() = inline_scene(test_support::scene_of_nodes(kUnbounded));
  const absl::Status refused = c.slice(unbounded).status();
  EXPECT_NE(refused.message().find("origin, spacing and counts: expected"), std::string::npos) << refused;
}

TEST(Surface, BallsMeasureWhatTheFormulasSay) {
  Client c = client();
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(two_balls());
  request.set_cell_size(0.04);
  const auto m = c.measure(request);
  ASSERT_TRUE(m.ok()) << m.status();
  EXPECT_NEAR(m->volume(), 2 * 4.0 / 3 * M_PI, 0.01);
  EXPECT_NEAR(m->area(), 2 * 4 * M_PI, 0.02);
  EXPECT_NEAR(m->centroid(0), 0, 1e-3);
  EXPECT_NEAR(m->bounds_max(0), 3, 1e-3);
  EXPECT_GT(m->summary().triangles(), 0u);
}

TEST(Surface, TheCommandLineAsksTheSame) {
  const TemporaryDirectory directory;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(directory.path(name)) << text;
    return directory.path(name);
  };
  const std::string scene =
      write("ball.json", R"({"nodes": [{"name": "ball", "sphere": {"radius": 1, "range": 0.5}}]})");
  const std::string points = write("points.csv", "x,y,z\n0,0,1.25\n0,0,9\n");
  const auto isofield = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {ISOFIELD_COMMAND, "--server", shared_daemon().address()});
    return run(arguments);
  };
  Outcome o = isofield({"ray", scene, "--origins", points, "--direction", "0,0,-2", "--max-distance", "1"});
  EXPECT_EQ(o.exit_code, 0) << o.errors;
  EXPECT_EQ(o.output.substr(0, o.output.find('\n')), "distance,x,y,z,nx,ny,nz,inside,node");
  EXPECT_NE(o.output.find(",0,ball\ninf,0,0,0,0,0,0,0,\n"), std::string::npos) << o.output;
  o = isofield({"inside", scene, "--points", points});
  EXPECT_EQ(o.output, "x,y,z,inside\n0,0,1.25,0\n0,0,9,0\n") << o.errors;
  o = isofield({"project", scene, "--points", points, "-o", directory.path("out.json")});
  EXPECT_EQ(o.exit_code, 0) << o.errors;
  o = isofield({"measure", scene, "--cell", "0.05"});
  EXPECT_NE(o.output.find("volume   4.1"), std::string::npos) << o.output << o.errors;
  const std::vector<std::string> slice{"slice", scene, "--origin=-2,-2,0", "--spacing", "0.1", "--counts", "41,41"};
  for (const char* name : {"slice.png", "slice.npy", "slice.csv"}) {
    std::vector<std::string> arguments = slice;
    arguments.insert(arguments.end(), {"-o", directory.path(name)});
    o = isofield(arguments);
    EXPECT_EQ(o.exit_code, 0) << name << ": " << o.errors;
    EXPECT_TRUE(std::ifstream(directory.path(name)).good()) << name;
  }
  o = isofield({"--json", "slice", scene, "-o", directory.path("whole.png")});
  EXPECT_EQ(o.exit_code, 0) << o.errors;
  EXPECT_NE(o.output.find("\"counts\":[512,"), std::string::npos) << o.output;
  write_file(directory.path("far.csv"), "500,0,0\n0.9,0,0\n");
  o = isofield({"project", scene, "--points", directory.path("far.csv")});
  EXPECT_NE(o.output.find("residual,out_of_reach\n500,0,0,"), std::string::npos) << o.output;
  EXPECT_NE(o.output.find(",0,inf,1\n"), std::string::npos) << o.output;
  EXPECT_NE(o.errors.find("note: 1 of 2 points are out of reach"), std::string::npos) << o.errors;
  EXPECT_EQ(isofield({"ray", scene, "--origins", points}).exit_code, 2);
  EXPECT_EQ(isofield({"ray", scene, "--origins", points, "--direction", "0,0,0"}).exit_code, 1);
  EXPECT_EQ(isofield({"inside", scene, "--points", directory.path("none.csv")}).exit_code, 4);
}

TEST(Surface, WrongRequestsAreRefused) {
  auto stub = v1::SurfaceService::NewStub(Peer(shared_daemon().address()).channel());
  const std::vector<float> two{0, 0, 5, 1, 1, 5}, down{0, 0, -1, 0, 0, -1};
  v1::CastRaysRequest good;
  *good.mutable_scene() = inlined(two_balls());
  *good.mutable_origins() = points_tensor(std::span<const float>(two));
  *good.mutable_directions() = points_tensor(std::span<const float>(down));
  const auto cast = [&](const v1::CastRaysRequest& request) {
    LimitedContext context;
    v1::CastRaysResponse response;
    return stub->CastRays(&context, request, &response);
  };
  ASSERT_TRUE(ok(cast(good)));
  v1::CastRaysRequest bad = good;
  *bad.mutable_directions() = points_tensor(std::span<const float>(std::vector<float>{0, 0, 1, 0, 0, 0}));
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"directions[1]", "(0, 0, 0)"});
  *bad.mutable_directions() = points_tensor(std::span<const float>(std::vector<float>{0, 0, 1}));
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"directions.shape", "2"});
  bad = good;
  *bad.mutable_origins() = points_tensor(std::span<const float>(std::vector<float>{0, 0, 1, 0, std::nanf(""), 0}));
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"origins[1].y", "nan"});
  *bad.mutable_origins() = points_tensor(std::span<const float>(std::vector<float>{0, 0, 2e9f, 0, 0, 0}));
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"origins[0].z", "2e+09"});
  bad = good;
  bad.set_max_distance(0);
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"max_distance = 0"});
  bad = good;
  bad.set_cell_size(-1);
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"cell_size = -1"});
  bad.set_cell_size(1e-7);
  expect_refused(cast(bad), StatusCode::RESOURCE_EXHAUSTED, {"cell_size = 1e-07", "smallest"});
  bad = good;
  bad.set_iso(1);
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"iso = 1", "]0, 1["});
  bad = good;
  bad.add_bounds_min(1);
  expect_refused(cast(bad), StatusCode::INVALID_ARGUMENT, {"bounds_min"});
  *bad.mutable_scene() = named("none");
  expect_refused(cast(bad), StatusCode::NOT_FOUND, {"none"});

  v1::SliceRequest plane;
  *plane.mutable_scene() = inlined(two_balls());
  const auto slice = [&](const v1::SliceRequest& request) {
    LimitedContext context;
    v1::SliceResponse response;
    return stub->Slice(&context, request, &response);
  };
  plane.add_origin(0);
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"origin holds 1"});
  plane.clear_origin();
  for (const double x : {0, 0, 0}) plane.add_origin(x);
  for (const double x : {1, 2, 3}) plane.add_u(x);
  for (const double x : {2, 4, 6}) plane.add_v(x);
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"v = (2, 4, 6)", "parallel"});
  plane.set_v(0, 5);
  for (int i = 0; i < 3; ++i) plane.add_spacing(0.1);
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"spacing holds 3"});
  plane.mutable_spacing()->Truncate(1);
  plane.add_counts(3);
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"counts holds 1"});
  plane.clear_counts();
  plane.add_counts(std::numeric_limits<std::uint64_t>::max());
  plane.add_counts(std::numeric_limits<std::uint64_t>::max());
  expect_refused(slice(plane), StatusCode::RESOURCE_EXHAUSTED, {"counts"});
  plane.set_counts(0, 0);
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"counts[0] = 0"});
  plane.set_counts(0, 3);
  plane.set_counts(1, 1);
  EXPECT_TRUE(ok(slice(plane)));
  plane.add_levels(std::nan(""));
  expect_refused(slice(plane), StatusCode::INVALID_ARGUMENT, {"levels[0]"});

  v1::ProjectPointsRequest points;
  *points.mutable_scene() = inlined(two_balls());
  *points.mutable_points() = points_tensor(std::span<const float>(two));
  points.set_tolerance(0);
  LimitedContext context;
  v1::ProjectPointsResponse response;
  expect_refused(stub->ProjectPoints(&context, points, &response), StatusCode::INVALID_ARGUMENT, {"tolerance = 0"});
}

}  // namespace
}  // namespace isofield::integration_test
