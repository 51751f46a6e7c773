#include "isofield/client.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>

#include "fake_server.h"
#include "support/eventually.h"
#include "test_support.h"

namespace isofield {
namespace {

v1::Scene ball() {
  v1::Scene scene;
  auto& node = *scene.add_nodes();
  node.set_name("ball");
  node.mutable_sphere()->set_radius(1);
  node.mutable_sphere()->set_range(1);
  return scene;
}

std::vector<float> points(std::size_t count) {
  std::vector<float> xyz(3 * count);
  for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] = static_cast<float>(i % 1000);
  return xyz;
}

class ClientTest : public ::testing::Test {
 protected:
  TemporaryDirectory directory_;
  const std::string address_ = "unix:" + directory_.path("socket");
  FakeServer server_{address_};
  Client client_ = *Client::connect(address_);
};

TEST_F(ClientTest, KeepsScenes) {
  const auto summary = client_.put_scene("a", ball());
  ASSERT_TRUE(summary.ok()) << summary.status();
  EXPECT_EQ(summary->nodes(), 1u);
  EXPECT_EQ(client_.list_scenes()->size(), 1u);
  EXPECT_EQ(client_.get_scene("a")->scene().SerializeAsString(), ball().SerializeAsString());
  v1::EditParametersRequest edit;
  edit.set_name("a");
  edit.add_edits()->set_node("ball");
  edit.mutable_edits(0)->set_field("center");
  for (const double v : {1, 2, 3}) edit.mutable_edits(0)->add_values(v);
  EXPECT_EQ(client_.edit_parameters(edit)->version(), 2u);
  EXPECT_TRUE(client_.delete_scene("a").ok());
  EXPECT_EQ(client_.delete_scene("a").code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(client_.get_scene("a").status().message(), "no scene \"a\"");
  EXPECT_EQ(client_.info()->version(), "0.0.0-fake");
}

TEST_F(ClientTest, PutsScenesOfManyNodes) {
  v1::Scene scene;
  for (int i = 0; i < 100000; ++i) *scene.add_nodes() = ball().nodes(0);
  EXPECT_EQ(client_.put_scene("many", scene)->nodes(), 100000u);
  EXPECT_EQ(client_.get_scene("many")->scene().nodes_size(), 100000);
}

TEST_F(ClientTest, PartsOfASceneThatAreNoneAreAnError) {
  ASSERT_TRUE(client_.put_scene("a", ball()).ok());
  server_.garbled_scene = true;
  const auto scene = client_.get_scene("a");
  EXPECT_EQ(scene.status().code(), absl::StatusCode::kInternal);
  EXPECT_TRUE(absl::StrContains(scene.status().message(), "8 bytes")) << scene.status();
}

TEST_F(ClientTest, ListsOfSeveralPagesAreJoined) {
  const std::vector<std::string> names{"a", "b", "c", "d", "e"};
  for (const std::string& name : names) ASSERT_TRUE(client_.put_scene(name, ball()).ok());
  for (const std::size_t entries : {1, 2, 5, 6}) {
    server_.page_entries = entries;
    const auto scenes = client_.list_scenes();
    ASSERT_TRUE(scenes.ok()) << scenes.status();
    std::vector<std::string> listed;
    for (const v1::SceneSummary& summary : *scenes) listed.push_back(summary.name());
    EXPECT_EQ(listed, names) << entries << " a page";
  }
}

TEST_F(ClientTest, ChunksThatAreAnsweredInPartsAreWhole) {
  const auto xyz = points(2 * Client::kChunkPoints + 7);
  const auto whole = client_.evaluate(inline_scene(ball()), xyz, true);
  ASSERT_TRUE(whole.ok()) << whole.status();
  server_.answer_rows = 10'000;
  const auto parts = client_.evaluate(inline_scene(ball()), xyz, true);
  ASSERT_TRUE(parts.ok()) << parts.status();
  EXPECT_EQ(*parts, *whole);
  EXPECT_EQ(server_.max_answer_bytes, 64u << 20) << "or the server would answer in parts where it need not";
}

TEST_F(ClientTest, EvaluatesBatchesOfAllSizes) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{64}, Client::kUnaryPoints, Client::kUnaryPoints + 1,
        Client::kChunkPoints, Client::kChunkPoints + 1, 10 * Client::kChunkPoints + 7}) {
    const auto xyz = points(count);
    for (const bool gradient : {false, true}) {
      const auto result = client_.evaluate(inline_scene(ball()), xyz, gradient);
      ASSERT_TRUE(result.ok()) << result.status();
      const std::size_t columns = gradient ? 4 : 1;
      ASSERT_EQ(result->size(), columns * count);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ((*result)[columns * i], xyz[3 * i] + 2 * xyz[3 * i + 1] + 3 * xyz[3 * i + 2]);
        if (gradient) {
          ASSERT_EQ((*result)[4 * i + 3], 3);
        }
      }
      std::vector<float> own(columns * count, -1);
      ASSERT_TRUE(client_.evaluate(inline_scene(ball()), xyz, gradient, own).ok());
      ASSERT_EQ(own, *result);
    }
  }
  EXPECT_EQ(server_.largest_chunk, Client::kChunkPoints);
}

TEST_F(ClientTest, SmallBatchesTravelInOneMessage) {
  ASSERT_TRUE(client_.evaluate(inline_scene(ball()), points(Client::kUnaryPoints), false).ok());
  EXPECT_EQ(server_.stream_messages, 0);
}

TEST_F(ClientTest, StreamsTenMillionPoints) {
  constexpr std::size_t kPoints = 10'000'000;
  std::size_t sent = 0, received = 0, wrong = 0;
  const auto status = client_.evaluate(
      inline_scene(ball()), false,
      [&](std::vector<float>& xyz) {
        const std::size_t count = std::min(Client::kChunkPoints, kPoints - sent);
        xyz.resize(3 * count);
        for (std::size_t i = 0; i < count; ++i) xyz[3 * i] = static_cast<float>(sent + i);
        sent += count;
        return absl::OkStatus();
      },
      [&](std::span<const float> xyz, std::span<const float> results) {
        for (std::size_t i = 0; i < results.size(); ++i) {
          wrong += results[i] != static_cast<float>(received + i) || results[i] != xyz[3 * i];
        }
        received += results.size();
        return absl::OkStatus();
      });
  EXPECT_TRUE(status.ok()) << status;
  EXPECT_EQ(received, kPoints);
  EXPECT_EQ(wrong, 0u);
}

TEST_F(ClientTest, RefusesOddCoordinatesAndResultsThatDoNotFit) {
  EXPECT_EQ(client_.evaluate(inline_scene(ball()), std::vector<float>(4), false).status().code(),
            absl::StatusCode::kInvalidArgument);
  std::vector<float> room(7);
  for (const std::size_t count : {std::size_t{3}, std::size_t{6}, std::size_t{8}}) {
    EXPECT_EQ(client_.evaluate(inline_scene(ball()), std::vector<float>(count), true, room).code(),
              absl::StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(server_.reads, 0);
}

TEST_F(ClientTest, ErrorsOfSourceAndSinkEndTheStream) {
  const auto endless = [](std::vector<float>& xyz) {
    xyz.resize(300);
    return absl::OkStatus();
  };
  const auto ignore = [](std::span<const float>, std::span<const float>) { return absl::OkStatus(); };
  int chunks = 0;
  EXPECT_EQ(client_.evaluate(
                inline_scene(ball()), false,
                [&](std::vector<float>& xyz) {
                  xyz.resize(300);
                  return ++chunks < 100 ? absl::OkStatus() : absl::DataLossError("line 100");
                },
                ignore),
            absl::DataLossError("line 100"));
  chunks = 0;
  EXPECT_EQ(client_.evaluate(inline_scene(ball()), false, endless,
                             [&](std::span<const float>, std::span<const float>) {
                               return ++chunks < 20 ? absl::OkStatus() : absl::DataLossError("disk full");
                             }),
            absl::DataLossError("disk full"));
  server_.fail_stream_after = 50;
  EXPECT_EQ(client_.evaluate(inline_scene(ball()), false, endless, ignore), absl::ResourceExhaustedError("too much"));
}

TEST_F(ClientTest, AnUnknownSceneEndsTheStream) {
  EXPECT_EQ(client_.evaluate(scene_by_name("none"), points(100000), false).status().code(),
            absl::StatusCode::kNotFound);
  // The stream fails even if there is nothing to evaluate.
  EXPECT_EQ(client_
                .evaluate(
                    scene_by_name("none"), false, [](std::vector<float>&) { return absl::OkStatus(); },
                    [](std::span<const float>, std::span<const float>) { return absl::OkStatus(); })
                .code(),
            absl::StatusCode::kNotFound);
}

TEST_F(ClientTest, RetriesReadsOnly) {
  server_.unavailable_for = 2;
  EXPECT_TRUE(client_.info().ok());
  EXPECT_EQ(server_.reads, 3);
  server_.unavailable_for = 2;
  EXPECT_TRUE(client_.evaluate(inline_scene(ball()), points(40000), true).ok());
  server_.unavailable_for = 2;
  v1::MeshRequest mesh;
  *mesh.mutable_scene() = inline_scene(ball());
  EXPECT_TRUE(client_.mesh(mesh).ok());
  server_.unavailable_for = 3;
  EXPECT_EQ(client_.list_scenes().status().code(), absl::StatusCode::kUnavailable);

  const std::function<absl::Status()> writes[] = {
      [&] { return client_.put_scene("a", ball()).status(); },
      [&] { return client_.edit_parameters(v1::EditParametersRequest()).status(); },
      [&] { return client_.delete_scene("a"); },
  };
  for (std::size_t i = 0; i < std::size(writes); ++i) {
    server_.writes = 0;
    server_.unavailable_for = 1;
    EXPECT_EQ(writes[i]().code(), absl::StatusCode::kUnavailable) << "write " << i;
    EXPECT_EQ(server_.writes, 1) << "write " << i;
  }
  // The client does not repeat what the server refuses.
  server_.reads = 0;
  EXPECT_EQ(client_.get_scene("none").status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(server_.reads, 1);
}

TEST_F(ClientTest, ComesBackToABusyServer) {
  server_.busy_for = 2;
  EXPECT_TRUE(client_.evaluate(inline_scene(ball()), points(2), false).ok());
  EXPECT_EQ(server_.reads, 3);
  server_.busy_for = 3;
  EXPECT_EQ(client_.evaluate(inline_scene(ball()), points(2), false).status().code(),
            absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(server_.reads, 6);
}

TEST_F(ClientTest, MalformedAnswersAreErrors) {
  server_.short_answer = true;
  EXPECT_EQ(client_.evaluate(inline_scene(ball()), points(2), false).status().code(), absl::StatusCode::kInternal);
  server_.wrong_summary = true;
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(ball());
  EXPECT_EQ(client_.mesh(request).status().code(), absl::StatusCode::kInternal);
}

TEST_F(ClientTest, EvaluatesGrids) {
  const auto grid = client_.evaluate_grid(inline_scene(ball()), {1, 2, 3}, {0.5, 0.25, 2}, {4, 3, 2}, false);
  ASSERT_TRUE(grid.ok()) << grid.status();
  ASSERT_EQ(grid->values.size(), 24u);
  EXPECT_EQ(grid->values[0], 14);
  EXPECT_EQ(grid->values[23], 1 + 1.5f + 2 * 2.5f + 3 * 5);
  for (std::size_t n = 0; n < 24; ++n) {
    const std::size_t row = n / 4 % 3, layer = n / 12;
    const auto i = static_cast<float>(n % 4), j = static_cast<float>(row), k = static_cast<float>(layer);
    EXPECT_EQ(grid->values[n], 1 + i / 2 + 2 * (2 + j / 4) + 3 * (3 + 2 * k)) << n;
  }
  EXPECT_EQ(server_.max_answer_bytes, 64u << 20);
  server_.misplaced_rows = true;
  EXPECT_EQ(client_.evaluate_grid(inline_scene(ball()), {1, 2, 3}, {0.5, 0.25, 2}, {4, 3, 2}, false).status().code(),
            absl::StatusCode::kInternal);
}

TEST_F(ClientTest, MeshesWithProgress) {
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(ball());
  std::vector<double> fractions;
  const auto mesh = client_.mesh(request, [&](const v1::MeshProgress& progress) {
    fractions.push_back(progress.fraction());
    return true;
  });
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  const auto expected = torus_mesh(64, 32, 1.0f, 0.4f);
  EXPECT_EQ(mesh->positions, expected.positions);
  EXPECT_EQ(mesh->normals, expected.normals);
  EXPECT_EQ(mesh->triangles, expected.triangles);
  EXPECT_EQ(fractions, (std::vector<double>{0, 0.25, 0.5, 0.75}));
  request.set_omit_normals(true);
  EXPECT_TRUE(client_.mesh(request)->normals.empty());
}

TEST_F(ClientTest, MeshesHaveTheNormalsOfCreasesWhereTheseAreAskedFor) {
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(ball());
  EXPECT_TRUE(client_.mesh(request)->creases.vertices.empty());
  request.set_crease_normals(true);
  const auto mesh = client_.mesh(request);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  const std::uint32_t vertex = mesh->triangles[0];
  EXPECT_EQ(mesh->creases.vertices, (std::vector<std::uint32_t>{vertex, vertex}));
  EXPECT_EQ(mesh->creases.normals, (std::vector<float>{1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh->creases.corners, (std::vector<std::uint32_t>{0, 1}));
  for (const std::vector<std::uint32_t>& wrong :
       {std::vector<std::uint32_t>{1, 1}, {0, 2}, {static_cast<std::uint32_t>(mesh->triangles.size()), 1}}) {
    server_.crease_corner = wrong;
    EXPECT_EQ(client_.mesh(request).status().code(), absl::StatusCode::kInternal);
  }
}

TEST_F(ClientTest, ACancelledMeshStopsTheServer) {
  server_.endless_mesh = true;
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(ball());
  int calls = 0;
  const auto mesh = client_.mesh(request, [&](const v1::MeshProgress&) { return ++calls < 5; });
  EXPECT_EQ(mesh.status().code(), absl::StatusCode::kCancelled);
  EXPECT_TRUE(test_support::eventually([&] { return server_.mesh_cancelled.load(); }));
}

TEST_F(ClientTest, StreamsHaveADeadlineWhenAsked) {
  server_.endless_mesh = true;
  ClientOptions options;
  options.stream_timeout = std::chrono::milliseconds(100);
  auto client = Client::connect(address_, options);
  v1::MeshRequest request;
  *request.mutable_scene() = inline_scene(ball());
  EXPECT_EQ(client->mesh(request).status().code(), absl::StatusCode::kDeadlineExceeded);
}

TEST(Client, APortThatNobodyListensAtIsTold) {
  // No usual program listens at port 1 of the loopback address.
  auto client = Client::connect("127.0.0.1:1");
  ASSERT_TRUE(client.ok());
  const auto status = client->info().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(status.message(), "nothing listens at 127.0.0.1:1; start isofieldd there");
}

TEST(Client, NoServerIsToldAtOnce) {
  const TemporaryDirectory directory;
  auto client = Client::connect("unix:" + directory.path("nothing"));
  ASSERT_TRUE(client.ok());
  const auto start = std::chrono::steady_clock::now();
  const auto status = client->info().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_TRUE(absl::StrContains(status.message(), "nothing listens at unix:")) << status;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace isofield
