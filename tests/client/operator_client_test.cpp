#include <gtest/gtest.h>

#include <functional>

#include "fake_server.h"
#include "isofield/client.h"
#include "test_support.h"

namespace isofield {
namespace {

class OperatorClient : public ::testing::Test {
 protected:
  static v1::EvaluateOperatorRequest request(const std::vector<std::string>& columns) {
    v1::EvaluateOperatorRequest request;
    request.mutable_inline_()->mutable_gradient();
    request.mutable_columns()->Assign(columns.begin(), columns.end());
    return request;
  }

  TemporaryDirectory directory_;
  const std::string address_ = "unix:" + directory_.path("socket");
  FakeServer server_{address_};
  Client client_ = *Client::connect(address_);
};

TEST_F(OperatorClient, KeepsOperators) {
  v1::Operator op;
  op.set_description("fold");
  op.mutable_gradient()->mutable_silhouette()->set_k(0.5);
  const auto summary = client_.put_operator("a", op);
  ASSERT_TRUE(summary.ok()) << summary.status();
  EXPECT_EQ(summary->version(), 1u);
  EXPECT_EQ(client_.list_operators()->size(), 2u);
  EXPECT_EQ(client_.get_operator("a")->operator_().SerializeAsString(), op.SerializeAsString());
  EXPECT_TRUE(client_.delete_operator("a").ok());
  EXPECT_EQ(client_.delete_operator("a").code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(client_.get_operator("a").status().message(), "no operator \"a\"");
  EXPECT_EQ(client_.put_operator("a", {}).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(OperatorClient, EvaluatesAnyNumberOfRows) {
  for (const std::size_t rows : {std::size_t{0}, std::size_t{1}, Client::kChunkPoints, 2 * Client::kChunkPoints + 3}) {
    std::vector<float> arguments(3 * rows);
    for (std::size_t i = 0; i < arguments.size(); ++i) arguments[i] = static_cast<float>(i % 100);
    const auto result = client_.evaluate_operator(request({"f1", "f2", "theta"}), arguments);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->columns, (std::vector<std::string>{"g", "dg_df1", "dg_df2", "dg_dtheta"}));
    ASSERT_EQ(result->values.size(), 4 * rows);
    for (std::size_t row = 0; row < rows; ++row) {
      ASSERT_EQ(result->values[4 * row], arguments[3 * row] + arguments[3 * row + 1] + arguments[3 * row + 2]);
    }
  }
  EXPECT_EQ(server_.largest_chunk, Client::kChunkPoints);
}

TEST_F(OperatorClient, EvaluatesOpenings) {
  v1::EvaluateOperatorRequest request;
  request.mutable_opening()->set_preset(v1::Opening::CAMEL);
  request.add_columns("alpha");
  const auto result = client_.evaluate_operator(request, std::vector<float>{1, 2});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->values, (std::vector<float>{0.25f, 0.25f, 0.5f, 0.25f}));
}

TEST_F(OperatorClient, ErrorsTellTheRows) {
  EXPECT_EQ(client_.evaluate_operator(request({"f1", "f2"}), std::vector<float>(3)).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(server_.reads, 0);
  std::vector<float> arguments(2 * (Client::kChunkPoints + 5));
  arguments.back() = -1;
  EXPECT_EQ(client_.evaluate_operator(request({"f1", "f2"}), arguments).status().message(),
            "after 65536 rows: arguments[4] < 0");
  server_.short_answer = true;
  EXPECT_EQ(client_.evaluate_operator(request({"f1", "f2"}), std::vector<float>(2)).status().code(),
            absl::StatusCode::kInternal);
}

TEST_F(OperatorClient, PicksOpenings) {
  const auto picked = client_.pick_opening(inline_scene({}), "top", {1, 2, 3});
  ASSERT_TRUE(picked.ok()) << picked.status();
  EXPECT_EQ(picked->theta(), 1);
  EXPECT_EQ(picked->alpha(), 2);
  EXPECT_EQ(picked->f1(), 3);
  EXPECT_EQ(client_.pick_opening(scene_by_name("none"), "top", {1, 2, 3}).status().code(), absl::StatusCode::kNotFound);
}

TEST_F(OperatorClient, RetriesReadsOnly) {
  v1::Operator op;
  op.mutable_gradient();
  ASSERT_TRUE(client_.put_operator("a", op).ok());
  const std::function<absl::Status()> reads[] = {
      [&] { return client_.list_operators().status(); },
      [&] { return client_.get_operator("a").status(); },
      [&] {
        return client_.evaluate_operator(request({"f1", "f2"}), std::vector<float>(2)).status();
      },
      [&] {
        return client_.pick_opening(inline_scene({}), "top", {1, 2, 3}).status();
      },
  };
  for (std::size_t i = 0; i < std::size(reads); ++i) {
    server_.reads = 0;
    server_.unavailable_for = 2;
    EXPECT_EQ(reads[i](), absl::OkStatus()) << "read " << i;
    EXPECT_EQ(server_.reads, 3) << "read " << i;
  }
  // A write that is sent again could undo what another client wrote in between.
  const std::function<absl::Status()> writes[] = {
      [&] { return client_.put_operator("a", op).status(); },
      [&] { return client_.delete_operator("a"); },
  };
  for (std::size_t i = 0; i < std::size(writes); ++i) {
    server_.writes = 0;
    server_.unavailable_for = 1;
    EXPECT_EQ(writes[i]().code(), absl::StatusCode::kUnavailable) << "write " << i;
    EXPECT_EQ(server_.writes, 1) << "write " << i;
  }
  EXPECT_EQ(server_.unavailable_for, 0);
}

}  // namespace
}  // namespace isofield
