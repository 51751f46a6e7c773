// Tests EvaluateStream with several messages at work: answers keep their order, and an error or a cancellation among
// them ends the stream.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <thread>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/eventually.h"
#include "support/random_scene.h"

namespace isofield::integration_test {
namespace {

constexpr std::size_t kPoints = 20'000;

v1::EvaluateStreamRequest first_message(const v1::Scene& scene) {
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = inlined(scene);
  request.set_quantity(v1::VALUE_AND_GRADIENT);
  return request;
}

v1::EvaluateStreamRequest message_of(std::span<const float> xyz) {
  v1::EvaluateStreamRequest request;
  *request.mutable_points() = points_tensor(xyz);
  return request;
}

TEST(Stream, AnswersKeepTheOrderOfLargeAndSmallMessages) {
  Peer peer(shared_daemon().address());
  // Small messages pass large ones at the device.
  const v1::Scene scene = test_support::random_scene(31, {.nodes = 60});
  std::vector<v1::EvaluateStreamRequest> requests{first_message(scene)};
  std::vector<std::vector<float>> sent;
  for (int i = 0; i < 40; ++i) {
    sent.push_back(points_around(Ball(), i, i % 2 == 0 ? kPoints : 1 + i));
    requests.push_back(message_of(sent.back()));
  }
  std::vector<v1::EvaluateResponse> responses;
  std::thread writer;
  LimitedContext context;
  const auto stream = peer.fields().EvaluateStream(&context);
  writer = std::thread([&] {
    for (const v1::EvaluateStreamRequest& request : requests) EXPECT_TRUE(stream->Write(request));
    stream->WritesDone();
  });
  v1::EvaluateResponse response;
  while (stream->Read(&response)) responses.push_back(response);
  writer.join();
  ASSERT_TRUE(ok(stream->Finish()));
  ASSERT_EQ(responses.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    std::vector<float> alone;
    ASSERT_TRUE(ok(peer.evaluate(inlined(scene), sent[i], true, &alone)));
    const std::vector<float> streamed = floats_of(responses[i].result());
    ASSERT_EQ(streamed.size(), alone.size());
    EXPECT_EQ(std::memcmp(streamed.data(), alone.data(), alone.size() * sizeof(float)), 0) << "message " << i;
  }
}

TEST(Stream, AnErrorComesAfterTheAnswersBeforeIt) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, kPoints);
  std::vector<float> bad = xyz;
  bad[3 * 7 + 1] = std::numeric_limits<float>::infinity();
  std::vector<v1::EvaluateStreamRequest> requests{first_message(ball.scene())};
  for (int i = 0; i < 6; ++i) requests.push_back(message_of(i == 3 ? bad : xyz));
  std::vector<v1::EvaluateResponse> responses;
  expect_refused(peer.evaluate_stream(requests, &responses), grpc::StatusCode::INVALID_ARGUMENT,
                 {"after 60000 points", "points[7].y = inf"});
  EXPECT_EQ(responses.size(), 3u);
  expect_serving(shared_daemon().address());
}

TEST(Stream, ASceneStatedTwiceEndsItAfterTheAnswersBefore) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, kPoints);
  const std::vector<v1::EvaluateStreamRequest> requests{first_message(ball.scene()), message_of(xyz), message_of(xyz),
                                                        first_message(ball.scene())};
  std::vector<v1::EvaluateResponse> responses;
  expect_refused(peer.evaluate_stream(requests, &responses), grpc::StatusCode::INVALID_ARGUMENT,
                 {"first message alone"});
  EXPECT_EQ(responses.size(), 2u);
}

TEST(Stream, CancelledWithMessagesAtWorkItGivesBackWhatItHeld) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, kPoints);
  const std::uint64_t bytes_before = peer.info().device_bytes();
  ASSERT_TRUE(ok(peer.put("streamed", ball.scene())));
  for (int i = 0; i < 20; ++i) {
    LimitedContext context;
    const auto stream = peer.fields().EvaluateStream(&context);
    v1::EvaluateStreamRequest request = first_message(ball.scene());
    *request.mutable_scene() = named("streamed");
    EXPECT_TRUE(stream->Write(request));
    for (int message = 0; message < i % 5; ++message) EXPECT_TRUE(stream->Write(message_of(xyz)));
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  EXPECT_GT(peer.info().device_bytes(), bytes_before);
  EXPECT_TRUE(ok(peer.remove("streamed")));
  // A stream that has not ended holds the scene, and work that has not ended holds its points.
  EXPECT_TRUE(test_support::eventually([&] { return peer.info().device_bytes() <= bytes_before; }))
      << peer.info().device_bytes() << " bytes on the device, " << bytes_before << " before the streams";
  expect_serving(shared_daemon().address());
}

TEST(Stream, NobodyReadsTheAnswersAndOthersAreServed) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  const std::vector<float> xyz = points_around(ball, 1, 65'536);
  const std::uint64_t bytes_before = peer.info().device_bytes();
  LimitedContext context;
  const auto stream = peer.fields().EvaluateStream(&context);
  EXPECT_TRUE(stream->Write(first_message(ball.scene())));
  std::thread writer([&] {
    while (stream->Write(message_of(xyz))) continue;  // until it is cancelled: the server takes no more
  });
  expect_serving(shared_daemon().address());
  context.TryCancel();
  writer.join();
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(test_support::eventually([&] { return peer.info().device_bytes() <= bytes_before; }))
      << peer.info().device_bytes() << " bytes on the device, " << bytes_before << " before the stream";
}

}  // namespace
}  // namespace isofield::integration_test
