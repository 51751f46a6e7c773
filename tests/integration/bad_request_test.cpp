// Tests that bad requests about good scenes are refused with status and text, and that the daemon goes on serving.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

const float kNaN = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

class BadRequest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(ok(peer_.put("ball", ball_.scene()))); }
  void TearDown() override {
    EXPECT_TRUE(ok(peer_.remove("ball")));
    EXPECT_TRUE(shared_daemon().is_running());
    expect_serving(shared_daemon().address());
  }

  v1::EvaluateRequest request_at(const std::vector<float>& xyz) {
    v1::EvaluateRequest request;
    *request.mutable_scene() = named("ball");
    *request.mutable_points() = points_tensor(std::span(xyz));
    return request;
  }
  void expect_points_refused(const v1::EvaluateRequest& request, StatusCode code, std::vector<std::string> parts) {
    v1::EvaluateResponse response;
    expect_refused(peer_.evaluate(request, &response), code, parts);
    // In a stream the text says how many points were answered before.
    std::vector<v1::EvaluateStreamRequest> stream(2);
    *stream[0].mutable_scene() = request.scene();
    stream[0].set_quantity(request.quantity());
    *stream[0].mutable_points() = points_tensor(std::span<const float>(kFive));
    *stream[1].mutable_points() = request.points();
    parts.push_back("after 5 points");
    std::vector<v1::EvaluateResponse> answers;
    expect_refused(peer_.evaluate_stream(stream, &answers), code, parts);
    EXPECT_EQ(answers.size(), 1u);
  }
  v1::EvaluateGridRequest grid(const std::vector<double>& origin, const std::vector<double>& spacing,
                               const std::vector<std::uint64_t>& counts) {
    v1::EvaluateGridRequest request;
    *request.mutable_scene() = named("ball");
    request.mutable_origin()->Assign(origin.begin(), origin.end());
    request.mutable_spacing()->Assign(spacing.begin(), spacing.end());
    request.mutable_counts()->Assign(counts.begin(), counts.end());
    return request;
  }

  const std::vector<float> kFive = std::vector<float>(15, 0.25f);
  Ball ball_;
  Peer peer_{shared_daemon().address()};
};

TEST_F(BadRequest, PointsThatAreNotFiniteAreNamed) {
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    std::vector<float> xyz(3 * 1000, 0.5f);
    xyz[3 * 637 + 1] = bad;
    expect_points_refused(request_at(xyz), StatusCode::INVALID_ARGUMENT,
                          {"points[637].y", absl::StrCat(bad), "finite"});
  }
  std::vector<double> wide(3 * 10, 0.5);
  wide[29] = 1e300;  // finite, but not as a float32
  v1::EvaluateRequest request = request_at({});
  *request.mutable_points() = points_tensor(std::span<const double>(wide));
  expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"points[9].z", "float32"});
}

TEST_F(BadRequest, BuffersThatDoNotFitTheirShapeAreRefused) {
  for (const std::size_t bytes : {0u, 1u, 11u, 13u, 59u, 61u, 72u}) {
    v1::EvaluateRequest request = request_at(kFive);
    request.mutable_points()->set_data(std::string(bytes, '\0'));
    expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {absl::StrCat(bytes, " bytes"), "60", "5 points"});
  }
  v1::EvaluateRequest request = request_at(kFive);
  request.mutable_points()->set_dtype(v1::Tensor::FLOAT64);
  expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"60 bytes", "120", "5 points"});
}

TEST_F(BadRequest, TypesAndShapesThatAreNotPointsAreRefused) {
  v1::EvaluateRequest request = request_at(kFive);
  request.mutable_points()->set_dtype(v1::Tensor::UINT32);
  expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"dtype", "UINT32", "FLOAT32 or FLOAT64"});
  request.mutable_points()->set_dtype(v1::Tensor::DTYPE_UNSPECIFIED);
  expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"dtype", "FLOAT32 or FLOAT64"});
  request.mutable_points()->set_dtype(static_cast<v1::Tensor::DType>(99));
  expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"dtype = 99", "FLOAT32 or FLOAT64"});
  for (const std::vector<std::uint64_t>& shape :
       {std::vector<std::uint64_t>{}, {15}, {3, 5}, {5, 4}, {5, 3, 1}, {1, 5, 3}, {5, 0}}) {
    request = request_at(kFive);
    request.mutable_points()->mutable_shape()->Assign(shape.begin(), shape.end());
    expect_points_refused(request, StatusCode::INVALID_ARGUMENT, {"shape", "[n, 3]"});
  }
  v1::EvaluateResponse response;
  request = request_at(kFive);
  request.clear_points();
  expect_refused(peer_.evaluate(request, &response), StatusCode::INVALID_ARGUMENT, {"points"});
}

TEST_F(BadRequest, ShapesBeyondTheLimitAreRefused) {
  for (const std::uint64_t count : {(1ull << 20) + 1, 1ull << 32, 1ull << 63, ~0ull, 0x5555555555555556ull}) {
    v1::EvaluateRequest request = request_at(kFive);
    request.mutable_points()->set_shape(0, count);
    expect_points_refused(request, StatusCode::RESOURCE_EXHAUSTED, {absl::StrCat(count), "1048576", "EvaluateStream"});
  }
}

TEST_F(BadRequest, QuantitiesThatAreNoneAreRefused) {
  v1::EvaluateRequest request = request_at(kFive);
  request.set_quantity(static_cast<v1::Quantity>(7));
  v1::EvaluateResponse response;
  expect_refused(peer_.evaluate(request, &response), StatusCode::INVALID_ARGUMENT, {"quantity = 7", "VALUE"});
}

TEST_F(BadRequest, UnknownScenesAreNamed) {
  expect_refused(peer_.evaluate(named("bell"), kFive, false, nullptr), StatusCode::NOT_FOUND, {"'bell'", "'ball'"});
  ReceivedMesh mesh;
  expect_refused(peer_.mesh(mesh_request(named("bell"), 0.1), &mesh), StatusCode::NOT_FOUND, {"'bell'"});
  v1::EvaluateGridRequest request = grid({0, 0, 0}, {1}, {2, 2, 2});
  *request.mutable_scene() = named("bell");
  expect_refused(peer_.evaluate_grid(request, nullptr), StatusCode::NOT_FOUND, {"'bell'"});
  std::vector<v1::EvaluateStreamRequest> stream(1);
  *stream[0].mutable_scene() = named("bell");
  expect_refused(peer_.evaluate_stream(stream, nullptr), StatusCode::NOT_FOUND, {"'bell'"});
}

TEST_F(BadRequest, RequestsWithoutASceneAreRefused) {
  expect_refused(peer_.evaluate(v1::SceneRef(), kFive, false, nullptr), StatusCode::INVALID_ARGUMENT,
                 {"scene", "name"});
  ReceivedMesh mesh;
  expect_refused(peer_.mesh(v1::MeshRequest(), &mesh), StatusCode::INVALID_ARGUMENT, {"scene", "name"});
  expect_refused(peer_.evaluate_stream({v1::EvaluateStreamRequest()}, nullptr), StatusCode::INVALID_ARGUMENT,
                 {"scene", "name"});
}

TEST_F(BadRequest, EmptyStreamsAreRefused) {
  expect_refused(peer_.evaluate_stream({}, nullptr), StatusCode::INVALID_ARGUMENT, {"empty", "first message"});
}

TEST_F(BadRequest, ScenesStatedTwiceInAStreamAreRefused) {
  std::vector<v1::EvaluateStreamRequest> stream(2);
  *stream[0].mutable_scene() = named("ball");
  *stream[1].mutable_scene() = named("ball");
  expect_refused(peer_.evaluate_stream(stream, nullptr), StatusCode::INVALID_ARGUMENT, {"scene", "first message"});
  stream[1].Clear();
  stream[1].set_quantity(v1::VALUE);
  expect_refused(peer_.evaluate_stream(stream, nullptr), StatusCode::INVALID_ARGUMENT, {"quantity", "first message"});
}

TEST_F(BadRequest, BadGridsAreRefused) {
  const double nan = kNaN, infinity = kInfinity;
  const struct {
    std::vector<double> origin, spacing;
    std::vector<std::uint64_t> counts;
    StatusCode code;
    std::vector<std::string> parts;
  } kBad[] = {
      {{0, 0}, {1}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"origin", "2 numbers", "3"}},
      {{0, nan, 0}, {1}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"origin[1] = nan", "finite"}},
      {{0, 0, 0}, {}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"spacing", "0 numbers"}},
      {{0, 0, 0}, {1, 1}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"spacing", "2 numbers"}},
      {{0, 0, 0}, {0}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"spacing[0] = 0", "> 0"}},
      {{0, 0, 0}, {1, -1, 1}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"spacing[1] = -1", "> 0"}},
      {{0, 0, 0}, {infinity}, {2, 2, 2}, StatusCode::INVALID_ARGUMENT, {"spacing[0] = inf", "finite"}},
      {{0, 0, 0}, {1}, {2, 2}, StatusCode::INVALID_ARGUMENT, {"counts", "2 numbers", "3"}},
      {{0, 0, 0}, {1}, {2, 0, 2}, StatusCode::INVALID_ARGUMENT, {"counts[1] = 0"}},
      {{0, 0, 0}, {1}, {1, 1, ~0ull}, StatusCode::INVALID_ARGUMENT, {"counts[2] = 18446744073709551615"}},
      {{0, 0, 0}, {1}, {2000, 2000, 2000}, StatusCode::RESOURCE_EXHAUSTED, {"4294967296"}},
      {{0, 0, 0}, {1}, {4000, 4000, 1}, StatusCode::RESOURCE_EXHAUSTED, {"layer", "16000000", "1048576"}},
  };
  for (const auto& bad : kBad) {
    SCOPED_TRACE(bad.parts[0]);
    expect_refused(peer_.evaluate_grid(grid(bad.origin, bad.spacing, bad.counts), nullptr), bad.code, bad.parts);
  }
}

TEST_F(BadRequest, BadMeshesAreRefused) {
  const double nan = kNaN, infinity = kInfinity;
  const auto refused = [&](const v1::MeshRequest& request, const std::vector<std::string>& parts) {
    SCOPED_TRACE(parts[0]);
    ReceivedMesh mesh;
    expect_refused(peer_.mesh(request, &mesh), StatusCode::INVALID_ARGUMENT, parts);
  };
  for (const double cell : {0.0, -1.0, nan, infinity}) {
    refused(mesh_request(named("ball"), cell), {absl::StrCat("cell_size = ", cell), "> 0"});
  }
  v1::MeshRequest request = mesh_request(named("ball"), 0.1);
  for (const std::uint32_t resolution : {0u, 1048577u}) {
    request.set_resolution(resolution);
    refused(request, {absl::StrCat("resolution = ", resolution), "[1, 1048576]"});
  }
  for (const double iso : {-0.5, 1.0, 1.5, nan, infinity}) {
    request = mesh_request(named("ball"), 0.1);
    request.set_iso(iso);
    refused(request, {absl::StrCat("iso = ", iso), "]0, 1["});
  }
  for (const double tolerance : {0.0, -1e-3, 9e-6, 0.11, nan, infinity}) {
    request = mesh_request(named("ball"), 0.1);
    request.set_tolerance(tolerance);
    refused(request, {absl::StrCat("tolerance = ", tolerance), "[1e-05, 0.1]", "0.001"});
  }
  for (const double error : {0.0, -1.0, nan, infinity}) {
    request = mesh_request(named("ball"), 0.1);
    request.set_simplification_error(error);
    refused(request, {absl::StrCat("simplification_error = ", error), "> 0"});
    LimitedContext context;
    v1::MeasureResponse measured;
    expect_refused(peer_.meshes().Measure(&context, request, &measured), StatusCode::INVALID_ARGUMENT,
                   {absl::StrCat("simplification_error = ", error), "> 0"});
  }
  const struct {
    std::vector<double> low, high;
    std::vector<std::string> parts;
  } kBounds[] = {
      {{-1, -1, -1}, {1, -2, 1}, {"bounds along y", "[-1, -2]"}},
      {{-1, -1, 1}, {1, 1, 1}, {"bounds along z", "[1, 1]"}},
      {{nan, -1, -1}, {1, 1, 1}, {"bounds along x", "finite"}},
      {{-1, -1, -1}, {1, 1, infinity}, {"bounds along z", "finite"}},
      {{-1, -1, -1}, {}, {"bounds_min and bounds_max", "3 and 0"}},
      {{}, {1, 1, 1}, {"bounds_min and bounds_max", "0 and 3"}},
      {{-1, -1}, {1, 1}, {"bounds_min and bounds_max", "2 and 2"}},
  };
  for (const auto& bounds : kBounds) {
    request = mesh_request(named("ball"), 0.1);
    request.mutable_bounds_min()->Assign(bounds.low.begin(), bounds.low.end());
    request.mutable_bounds_max()->Assign(bounds.high.begin(), bounds.high.end());
    refused(request, bounds.parts);
  }
}

// Returns the number that ends a refusal's text.
double smallest_cell_of(const grpc::Status& status) {
  const std::string& text = status.error_message();
  const std::size_t at = text.find("smallest cell size that fits is ");
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? 0 : std::stod(text.substr(at + 32));
}

TEST(BadRequestOfCells, TheSmallestCellThatFitsIsStatedAndFits) {
  constexpr std::uint64_t kCells = 100'000;
  Daemon daemon({"--max-mesh-cells", std::to_string(kCells)});
  Peer peer(daemon.address());
  const Ball ball;
  for (const double asked : {0.004, 1e-4, 1e-7, 1e-12, 1e-300}) {
    SCOPED_TRACE(asked);
    ReceivedMesh mesh;
    v1::MeshRequest request = mesh_request(inlined(ball.scene()), asked);
    const grpc::Status status = peer.mesh(request, &mesh);
    expect_refused(status, StatusCode::RESOURCE_EXHAUSTED, {absl::StrCat("cell_size = ", asked)});
    const double stated = smallest_cell_of(status);
    ASSERT_GT(stated, 0);
    request.set_cell_size(stated);
    ASSERT_TRUE(ok(peer.mesh(request, &mesh)));
    EXPECT_LE(mesh.summary.cells(), kCells);
    EXPECT_GT(mesh.summary.cells(), kCells / 2) << "not far from the limit";
  }
  v1::MeshRequest request = mesh_request(inlined(ball.scene()), 1);
  request.set_resolution(1048576);
  ReceivedMesh mesh;
  const grpc::Status refused = peer.mesh(request, &mesh);
  expect_refused(refused, StatusCode::RESOURCE_EXHAUSTED, {"resolution = 1048576", "largest resolution that fits is "});
  const std::string& text = refused.error_message();
  request.set_resolution(static_cast<std::uint32_t>(std::stoul(text.substr(text.rfind(' ')))));
  EXPECT_TRUE(ok(peer.mesh(request, &mesh))) << text;
  request.clear_cells();
  mesh = ReceivedMesh();
  EXPECT_TRUE(ok(peer.mesh(request, &mesh))) << "a cell size that the server chooses must fit what it admits";
  expect_serving(daemon.address());
}

TEST(BadRequestOfSize, MessagesBeyondTheLimitAreRefusedAndTheConnectionLives) {
  Daemon daemon({"--max-message-bytes", "65536", "--max-points-per-message", "1000"});
  Peer peer(daemon.address());
  const Ball ball;
  expect_refused(peer.evaluate(inlined(ball.scene()), points_around(ball, 1, 20'000), false, nullptr),
                 StatusCode::RESOURCE_EXHAUSTED, {"larger than max", "65536"});
  expect_refused(peer.evaluate(inlined(ball.scene()), points_around(ball, 1, 1001), false, nullptr),
                 StatusCode::RESOURCE_EXHAUSTED, {"1001", "1000", "EvaluateStream"});
  EXPECT_TRUE(ok(peer.evaluate(inlined(ball.scene()), points_around(ball, 1, 1000), false, nullptr)));
  expect_serving(daemon.address());
}

// Idle streams hold threads. Streams beyond the limit are refused, and other calls go through all the while.
TEST(Streams, AreFewerThanThreads) {
  Daemon daemon({"--max-threads", "8"});
  Peer peer(daemon.address());
  const Ball ball;
  struct Stream {
    LimitedContext context;
    std::unique_ptr<grpc::ClientReaderWriter<v1::EvaluateStreamRequest, v1::EvaluateResponse>> call;
  };
  std::vector<std::unique_ptr<Stream>> open;
  const auto begin = [&](Stream& stream) {
    stream.call = peer.fields().EvaluateStream(&stream.context);
    const float origin[] = {0, 0, 0};
    v1::EvaluateStreamRequest request;
    *request.mutable_scene() = inlined(ball.scene());
    *request.mutable_points() = points_tensor(std::span(origin));
    v1::EvaluateResponse response;
    return stream.call->Write(request) && stream.call->Read(&response);
  };
  for (int i = 0; i < 6; ++i) {
    open.push_back(std::make_unique<Stream>());
    ASSERT_TRUE(begin(*open.back())) << i;
  }
  Stream refused;
  EXPECT_FALSE(begin(refused));
  const grpc::Status status = refused.call->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(status.error_message().find("6 streams are open"), std::string::npos) << status.error_message();
  EXPECT_TRUE(ok(peer.put("ball", ball.scene())));
  // A stream that ends makes room.
  open.back()->call->WritesDone();
  EXPECT_TRUE(open.back()->call->Finish().ok());
  Stream next;
  EXPECT_TRUE(begin(next));
  for (auto& stream : open) stream->context.TryCancel();
  next.context.TryCancel();
}

}  // namespace
}  // namespace isofield::integration_test
