// Clients that set no option receive messages of up to 4 MiB: streams are cut below that, and single answers that would
// be larger are refused with a word on what to do.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr std::uint64_t kDefaultBytes = 4194304;
constexpr std::uint64_t kAny = ~0ull;

class MessageSize : public testing::Test {
 protected:
  v1::EvaluateGridRequest grid(const std::array<std::uint64_t, 3>& counts, bool gradient) {
    v1::EvaluateGridRequest request;
    *request.mutable_scene() = inlined(Ball().scene());
    request.set_quantity(gradient ? v1::VALUE_AND_GRADIENT : v1::VALUE);
    for (const std::uint64_t n : counts) request.add_counts(n);
    for (const double x : {-1.5, -2.0, -1.6}) request.add_origin(x);
    for (const std::uint64_t n : counts) request.add_spacing(3.5 / static_cast<double>(n));
    return request;
  }
  // Returns the joined answer to one message of a stream, and the size of the largest message in it.
  std::vector<float> streamed(Peer& peer, const v1::EvaluateStreamRequest& request, std::uint64_t* largest,
                              std::size_t* messages) {
    std::vector<v1::EvaluateResponse> responses;
    EXPECT_TRUE(ok(peer.evaluate_stream({request}, &responses)));
    std::vector<float> joined;
    for (const v1::EvaluateResponse& response : responses) {
      const std::vector<float> part = floats_of(response.result());
      joined.insert(joined.end(), part.begin(), part.end());
      *largest = std::max<std::uint64_t>(*largest, response.ByteSizeLong());
    }
    *messages = responses.size();
    return joined;
  }

  Peer plain_{shared_daemon().address(), Peer::Messages::kByDefault};
  Peer peer_{shared_daemon().address()};
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

TEST_F(MessageSize, GridsOfEveryShapeReachClientsWithoutOptions) {
  for (const std::array<std::uint64_t, 3>& counts : {std::array<std::uint64_t, 3>{1, 1, 1},
                                                     {64, 64, 64},
                                                     {128, 128, 128},
                                                     {63, 65, 66},
                                                     {1000, 1000, 2},
                                                     {3, 200'000, 2},
                                                     {300'000, 2, 3}}) {
    SCOPED_TRACE(absl::StrCat(counts[0], " x ", counts[1], " x ", counts[2]));
    v1::EvaluateGridRequest request = grid(counts, true);
    std::vector<float> plain, few, whole;
    EXPECT_TRUE(ok(plain_.evaluate_grid(request, &plain)));
    request.set_max_answer_bytes(65536);
    std::size_t messages = 0;
    EXPECT_TRUE(ok(peer_.evaluate_grid(request, &few, &messages)));
    EXPECT_GE(messages, plain.size() * sizeof(float) / 65536);
    request.set_max_answer_bytes(kAny);
    EXPECT_TRUE(ok(peer_.evaluate_grid(request, &whole)));
    EXPECT_TRUE(same_bits(plain, whole));
    EXPECT_TRUE(same_bits(few, whole));
  }
}

TEST_F(MessageSize, GridsAreInFewMessagesWhereTheClientTakesThem) {
  v1::EvaluateGridRequest request = grid({64, 64, 64}, true);
  request.set_max_answer_bytes(kAny);
  std::size_t messages = 0;
  EXPECT_TRUE(ok(peer_.evaluate_grid(request, nullptr, &messages)));
  EXPECT_EQ(messages, 1u);
}

TEST_F(MessageSize, LargeChunksAreAnsweredInParts) {
  const std::vector<float> xyz = points_around(Ball(), 1, 700'000);
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  request.set_quantity(v1::VALUE_AND_GRADIENT);
  *request.mutable_points() = points_tensor(std::span(xyz));
  std::vector<float> whole;
  ASSERT_TRUE(ok(peer_.evaluate(request.scene(), xyz, true, &whole)));
  std::uint64_t largest = 0;
  std::size_t messages = 0;
  EXPECT_TRUE(same_bits(streamed(plain_, request, &largest, &messages), whole));
  EXPECT_LE(largest, kDefaultBytes);
  EXPECT_EQ(messages, 3u);
  request.set_max_answer_bytes(65536);
  largest = 0;
  EXPECT_TRUE(same_bits(streamed(plain_, request, &largest, &messages), whole));
  EXPECT_LE(largest, 65536u);
  request.set_max_answer_bytes(kAny);
  EXPECT_TRUE(same_bits(streamed(peer_, request, &largest, &messages), whole));
  EXPECT_EQ(messages, 1u);
}

// A chunk that is answered in parts counts as a whole: an error after it states how many points have been answered.
TEST_F(MessageSize, AnErrorComesAfterAllPartsOfTheChunkBefore) {
  const std::vector<float> xyz = points_around(Ball(), 1, 300'000);
  std::vector<float> bad(3, 0.0f);
  bad[1] = std::numeric_limits<float>::quiet_NaN();
  std::vector<v1::EvaluateStreamRequest> requests(2);
  *requests[0].mutable_scene() = inlined(Ball().scene());
  requests[0].set_quantity(v1::VALUE_AND_GRADIENT);
  *requests[0].mutable_points() = points_tensor(std::span(xyz));
  *requests[1].mutable_points() = points_tensor(std::span<const float>(bad));
  std::vector<v1::EvaluateResponse> responses;
  expect_refused(plain_.evaluate_stream(requests, &responses), StatusCode::INVALID_ARGUMENT,
                 {"after 300000 points", "points[0].y"});
  EXPECT_EQ(responses.size(), 2u);
}

TEST_F(MessageSize, StreamsRefuseMessagesTooSmallForRows) {
  v1::EvaluateGridRequest request = grid({2, 2, 2}, false);
  request.set_max_answer_bytes(65535);
  expect_refused(peer_.evaluate_grid(request, nullptr), StatusCode::INVALID_ARGUMENT,
                 {"max_answer_bytes = 65535", "65536"});
  v1::EvaluateStreamRequest first;
  *first.mutable_scene() = inlined(Ball().scene());
  first.set_max_answer_bytes(1);
  expect_refused(peer_.evaluate_stream({first}, nullptr), StatusCode::INVALID_ARGUMENT,
                 {"max_answer_bytes = 1:", "65536"});
  first.set_max_answer_bytes(0);
  v1::EvaluateStreamRequest second;
  second.set_max_answer_bytes(65536);
  expect_refused(peer_.evaluate_stream({first, second}, nullptr), StatusCode::INVALID_ARGUMENT,
                 {"max_answer_bytes", "first message"});
}

// Asks for the largest batch that a client without options receives, and for one more point.
TEST_F(MessageSize, EvaluateRefusesWhatTheClientWouldNotTake) {
  v1::EvaluateRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  request.set_quantity(v1::VALUE_AND_GRADIENT);
  v1::EvaluateResponse response;
  const std::vector<float> xyz = points_around(Ball(), 1, 262'143);
  const auto first = [&](std::size_t points) {
    *request.mutable_points() = points_tensor(std::span(xyz).first(3 * points));
    return plain_.evaluate(request, &response);
  };
  ASSERT_TRUE(ok(first(262'142)));
  EXPECT_LE(response.ByteSizeLong(), kDefaultBytes);
  expect_refused(first(262'143), StatusCode::RESOURCE_EXHAUSTED,
                 {absl::StrCat(262'143 * 16 + 18), "4194304", "EvaluateStream", "max_answer_bytes"});
  request.set_max_answer_bytes(262'143 * 16 + 18);
  EXPECT_TRUE(ok(peer_.evaluate(request, &response)));
  EXPECT_EQ(response.ByteSizeLong(), request.max_answer_bytes());
  request.set_max_answer_bytes(request.max_answer_bytes() - 1);
  expect_refused(peer_.evaluate(request, &response), StatusCode::RESOURCE_EXHAUSTED, {"EvaluateStream"});
}

TEST_F(MessageSize, QuestionsAboutSurfacesRefuseWhatTheClientWouldNotTake) {
  v1::Tensor many = points_tensor(std::span<const float>(points_around(Ball(), 1, 150'000)));
  const auto scene = inlined(Ball().scene());

  LimitedContext contexts[8];
  v1::ProjectPointsRequest project;
  *project.mutable_scene() = scene;
  *project.mutable_points() = many;
  v1::ProjectPointsResponse projected;
  expect_refused(plain_.surfaces().ProjectPoints(&contexts[0], project, &projected), StatusCode::RESOURCE_EXHAUSTED,
                 {"4350000", "4194304", "fewer rows"});
  project.set_max_answer_bytes(kAny);
  EXPECT_TRUE(ok(peer_.surfaces().ProjectPoints(&contexts[1], project, &projected)));

  v1::CastRaysRequest cast;
  *cast.mutable_scene() = scene;
  *cast.mutable_origins() = many;
  *cast.mutable_directions() = many;
  v1::CastRaysResponse hits;
  expect_refused(plain_.surfaces().CastRays(&contexts[2], cast, &hits), StatusCode::RESOURCE_EXHAUSTED,
                 {"4950000", "4194304", "fewer rows"});

  v1::ContainsRequest contains;
  *contains.mutable_scene() = scene;
  *contains.mutable_points() = many;
  contains.set_max_answer_bytes(150'000);
  v1::ContainsResponse inside;
  expect_refused(plain_.surfaces().Contains(&contexts[3], contains, &inside), StatusCode::RESOURCE_EXHAUSTED,
                 {"150000", "fewer rows"});
  contains.clear_max_answer_bytes();
  EXPECT_TRUE(ok(plain_.surfaces().Contains(&contexts[4], contains, &inside)));

  v1::SliceRequest slice;
  *slice.mutable_scene() = scene;
  for (const double x : {-1.5, -2.0, 0.0}) slice.add_origin(x);
  for (const double x : {1, 0, 0}) slice.add_u(x);
  for (const double x : {0, 1, 0}) slice.add_v(x);
  slice.add_spacing(0.003);
  slice.add_counts(1024);
  slice.add_counts(1024);
  v1::SliceResponse sliced;
  expect_refused(plain_.surfaces().Slice(&contexts[5], slice, &sliced), StatusCode::RESOURCE_EXHAUSTED,
                 {"4194304", "part of the plane"});
  slice.set_max_answer_bytes(kAny);
  EXPECT_TRUE(ok(peer_.surfaces().Slice(&contexts[6], slice, &sliced)));
}

TEST_F(MessageSize, OperatorsRefuseWhatTheClientWouldNotTake) {
  v1::EvaluateOperatorRequest request;
  request.set_name("sum");
  request.add_columns("f1");
  request.add_columns("f2");
  std::vector<float> arguments(2 * 400'000, 0.25f);
  v1::Tensor& tensor = *request.mutable_arguments();
  tensor.set_dtype(v1::Tensor::FLOAT32);
  tensor.add_shape(400'000);
  tensor.add_shape(2);
  tensor.set_data(arguments.data(), arguments.size() * sizeof(float));
  v1::EvaluateOperatorResponse response;
  LimitedContext contexts[2];
  expect_refused(plain_.operators().EvaluateOperator(&contexts[0], request, &response), StatusCode::RESOURCE_EXHAUSTED,
                 {"4800000", "4194304", "fewer rows"});
  request.set_max_answer_bytes(kAny);
  EXPECT_TRUE(ok(peer_.operators().EvaluateOperator(&contexts[1], request, &response)));
}

TEST_F(MessageSize, LargeScenesComeInParts) {
  v1::Scene scene;
  for (int i = 0; i < 60'000; ++i) {
    v1::Node& node = *scene.add_nodes();
    node.set_name(absl::StrCat("a name that is long enough to make a scene large/", i));
    for (const double x : {i % 40 * 1.0, i / 40 % 40 * 1.0, i / 1600 * 1.0}) node.mutable_sphere()->add_center(x);
    node.mutable_sphere()->set_radius(0.1);
    node.mutable_sphere()->set_range(0.1);
  }
  v1::Node& sum = *scene.add_nodes();
  for (int i = 0; i < 60'000; ++i) sum.mutable_sum()->add_children(absl::StrCat("#", i));
  ASSERT_GT(scene.ByteSizeLong(), kDefaultBytes);
  ASSERT_TRUE(ok(peer_.put("large", scene)));

  v1::GetSceneResponse whole;
  expect_refused(plain_.get("large", &whole), StatusCode::RESOURCE_EXHAUSTED,
                 {absl::StrCat(scene.ByteSizeLong()), "4194304", "GetSceneParts"});
  LimitedContext contexts[3];
  v1::GetSceneRequest request;
  request.set_name("large");
  request.set_max_answer_bytes(kAny);
  EXPECT_TRUE(ok(peer_.scenes().GetScene(&contexts[0], request, &whole)));

  const auto stream = plain_.scenes().GetSceneParts(&contexts[1], request);
  v1::ScenePart part;
  std::string bytes;
  for (int n = 0; stream->Read(&part); ++n) {
    EXPECT_EQ(part.has_summary(), n == 0);
    if (n == 0) {
      EXPECT_EQ(part.summary().nodes(), 60'001u);
    }
    EXPECT_LE(part.data().size(), 1u << 20);
    bytes += part.data();
  }
  EXPECT_TRUE(ok(stream->Finish()));
  EXPECT_EQ(bytes, scene.SerializeAsString());

  request.set_name("none");
  const auto missing = plain_.scenes().GetSceneParts(&contexts[2], request);
  EXPECT_FALSE(missing->Read(&part));
  expect_refused(missing->Finish(), StatusCode::NOT_FOUND, {"'none'"});
  EXPECT_TRUE(ok(peer_.remove("large")));
}

TEST_F(MessageSize, ScenesAreListedFromANameOn) {
  for (const char* name : {"a", "b", "c"}) ASSERT_TRUE(ok(peer_.put(name, Ball().scene())));
  v1::ListScenesRequest request;
  request.set_after("a");
  LimitedContext context;
  v1::ListScenesResponse response;
  ASSERT_TRUE(ok(plain_.scenes().ListScenes(&context, request, &response)));
  ASSERT_EQ(response.scenes_size(), 2);
  EXPECT_EQ(response.scenes(0).name(), "b");
  EXPECT_EQ(response.scenes(1).name(), "c");
  EXPECT_FALSE(response.has_more());
  for (const char* name : {"a", "b", "c"}) EXPECT_TRUE(ok(peer_.remove(name)));
}

// Descriptions make lists of operators long. A summary has only the beginning of a description, and a list that is
// longer than a message goes on where it is asked for again.
TEST_F(MessageSize, LongListsOfOperatorsComeInPages) {
  Daemon daemon;
  Peer peer(daemon.address(), Peer::Messages::kByDefault);
  v1::PutOperatorRequest put;
  put.mutable_operator_()->mutable_sum();
  // The 1,024th byte of this description is within a character.
  put.mutable_operator_()->set_description(std::string(1023, 'd') + "\xc3\xbc" + std::string(5000, 'd'));
  const auto name = [](int i) { return absl::StrCat("operator-", absl::Dec(i, absl::kZeroPad4)); };
  for (int i = 0; i < 4500; ++i) {
    put.set_name(name(i));
    LimitedContext context;
    v1::PutOperatorResponse response;
    ASSERT_TRUE(ok(peer.operators().PutOperator(&context, put, &response)));
    if (i == 0) put.mutable_operator_()->set_description(std::string(5000, 'd'));
  }
  int listed = 0, built_in = 0, pages = 0;
  v1::ListOperatorsRequest request;
  v1::ListOperatorsResponse response;
  do {
    ++pages;
    LimitedContext context;
    ASSERT_TRUE(ok(peer.operators().ListOperators(&context, request, &response)));
    for (const v1::OperatorSummary& summary : response.operators()) {
      if (summary.version() == 0) {
        ++built_in;
        continue;
      }
      EXPECT_EQ(summary.name(), name(listed));
      EXPECT_EQ(summary.description().size(), listed == 0 ? 1023u : 1024u);
      ++listed;
    }
    request.set_after(response.operators(response.operators_size() - 1).name());
  } while (response.has_more());
  EXPECT_EQ(listed, 4500);
  EXPECT_GT(built_in, 10);
  EXPECT_EQ(pages, 2);
}

TEST_F(MessageSize, MeshesOfAMillionTrianglesReachClientsWithoutOptions) {
  const v1::SceneRef scene = inlined(Ball().scene());
  v1::MeshRequest request = mesh_request(scene, 0.0045);
  ReceivedMesh mesh;
  ASSERT_TRUE(ok(plain_.mesh(request, &mesh)));
  EXPECT_GT(mesh.summary.triangles(), 1'000'000u);
  LimitedContext context;
  v1::MeshBricksRequest bricks;
  *bricks.mutable_mesh() = request;
  const auto stream = plain_.meshes().GetMeshBricks(&context, bricks);
  v1::MeshBricksResponse response;
  std::uint64_t largest = 0;
  while (stream->Read(&response)) largest = std::max<std::uint64_t>(largest, response.ByteSizeLong());
  EXPECT_TRUE(ok(stream->Finish()));
  EXPECT_EQ(response.summary().triangles(), mesh.summary.triangles());
  EXPECT_LE(largest, 2u << 20);
}

}  // namespace
}  // namespace isofield::integration_test
