// Tests OperatorService: custom operators by name, and evaluation of operators by themselves.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "integration/operator_fixture.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr float kPi = std::numbers::pi_v<float>;

v1::Operator of_kind(const std::string& name) {
  v1::Operator message;
  message.GetReflection()->MutableMessage(&message, v1::Operator::descriptor()->FindFieldByName(name));
  return message;
}

using Operator = OperatorFixture;

TEST_F(Operator, KeepsWhatWasPutUntilItIsDeleted) {
  v1::Operator message = bulge(0.5);
  message.set_description("a fold");
  v1::OperatorSummary summary;
  ASSERT_TRUE(ok(put("a/fold-1.b_c", message, &summary)));
  EXPECT_EQ(summary.name(), "a/fold-1.b_c");
  EXPECT_GT(summary.version(), 0u);
  EXPECT_EQ(summary.kind(), "gradient");
  EXPECT_EQ(summary.law(), v1::POSITIVE);
  EXPECT_EQ(summary.description(), "a fold");
  ASSERT_EQ(summary.arguments_size(), 3);
  EXPECT_EQ(summary.arguments(2), "theta");
  v1::GetOperatorResponse got;
  ASSERT_TRUE(ok(get("a/fold-1.b_c", &got)));
  EXPECT_EQ(got.operator_().SerializeAsString(), message.SerializeAsString());
  EXPECT_EQ(got.summary().SerializeAsString(), summary.SerializeAsString());
  EXPECT_EQ(peer_.info().operators(), 1u);
  EXPECT_TRUE(ok(remove("a/fold-1.b_c")));
  expect_refused(get("a/fold-1.b_c", &got), StatusCode::NOT_FOUND, {"a/fold-1.b_c", "gradient"});
  expect_refused(remove("a/fold-1.b_c"), StatusCode::NOT_FOUND, {"a/fold-1.b_c"});
  EXPECT_EQ(peer_.info().operators(), 0u);
}

TEST_F(Operator, ListsBuiltInOnesThenCustomOnesByName) {
  for (const char* name : {"b", "a", "C"}) ASSERT_TRUE(ok(put(name, bulge(0.5))));
  std::string built_in, custom;
  for (const v1::OperatorSummary& summary : list()) {
    if (summary.version() == 0) {
      EXPECT_TRUE(custom.empty());
      EXPECT_EQ(summary.kind(), summary.name());
      EXPECT_GE(summary.arguments_size(), 2);
      built_in += summary.name() + " ";
    } else {
      custom += summary.name() + " ";
    }
  }
  EXPECT_EQ(built_in,
            "sum max min difference ricci gradient clean barthe bernhardt r_union pasko superelliptic functional bt2 "
            "btk smooth_min sampled ");
  EXPECT_EQ(custom, "C a b ");
  v1::GetOperatorResponse got;
  ASSERT_TRUE(ok(get("gradient", &got)));
  EXPECT_EQ(got.summary().version(), 0u);
  EXPECT_EQ(got.operator_().gradient().ByteSizeLong(), 0u);
}

TEST_F(Operator, RefusesNamesAndOperators) {
  for (const std::string& name : {std::string(), std::string("a b"), std::string("#1"), std::string(129, 'x')}) {
    expect_refused(put(name, bulge(0.5)), StatusCode::INVALID_ARGUMENT, {"name", "A-Z a-z 0-9 _ - . /"});
  }
  expect_refused(put("gradient", bulge(0.5)), StatusCode::INVALID_ARGUMENT, {"'gradient'", "built-in"});
  expect_refused(remove("gradient"), StatusCode::NOT_FOUND, {"'gradient'", "built-in"});
  expect_refused(put("a", bulge(1.5)), StatusCode::INVALID_ARGUMENT, {"silhouette.k = 1.5", "[0, 1]"});
  expect_refused(put("a", {}), StatusCode::INVALID_ARGUMENT, {"kind"});
  v1::GetOperatorResponse got;
  expect_refused(get("a", &got), StatusCode::NOT_FOUND, {"'a'"});
}

TEST_F(Operator, EvaluatesTheBlend) {
  v1::EvaluateOperatorResponse response;
  // The columns come in another order than the engine's.
  ASSERT_TRUE(ok(evaluate(
      request(of_kind("gradient"), {"theta", "f2", "f1"}, {0, 0.5f, 0.5f, kPi / 4, 0.7f, 0.7f, 0.3f, 0, 0.25f}),
      &response)));
  EXPECT_EQ((std::vector<std::string>{response.columns().begin(), response.columns().end()}),
            (std::vector<std::string>{"g", "dg_df1", "dg_df2", "dg_dtheta"}));
  ASSERT_EQ(response.results().shape_size(), 2);
  EXPECT_EQ(response.results().shape(0), 3u);
  EXPECT_EQ(response.results().shape(1), 4u);
  const std::vector<float> g = floats_of(response.results());
  EXPECT_NEAR(g[0], 0.62013295, 1e-5);
  EXPECT_NEAR(g[1], g[2], 1e-4);
  EXPECT_NEAR(g[4], 0.74805318, 1e-5);
  EXPECT_EQ(g[8], 0.25f);
  EXPECT_EQ(g[9], 1.0f);
}

TEST_F(Operator, AlphaSteersThroughTheOpening) {
  v1::EvaluateOperatorRequest opening;
  opening.mutable_opening()->set_preset(v1::Opening::CAMEL);
  set_rows({"alpha"}, {0, 0.6f, kPi / 2, kPi}, opening);
  v1::EvaluateOperatorResponse response;
  ASSERT_TRUE(ok(evaluate(opening, &response)));
  EXPECT_EQ(response.columns(0), "theta");
  EXPECT_EQ(response.columns(1), "dtheta_dalpha");
  const std::vector<float> theta = floats_of(response.results());
  ASSERT_EQ(theta.size(), 8u);
  EXPECT_NEAR(theta[0], kPi / 4, 1e-6);
  EXPECT_LT(theta[3], 0);
  EXPECT_NEAR(theta[4], 0, 1e-6);
  EXPECT_NEAR(theta[6], kPi / 4, 1e-6);

  ASSERT_TRUE(ok(evaluate(request(of_kind("gradient"), {"f1", "f2", "alpha"}, {0.4f, 0.45f, 0.6f}), &response)));
  EXPECT_EQ(response.columns(3), "dg_dalpha");
  const std::vector<float> by_alpha = floats_of(response.results());
  ASSERT_TRUE(ok(evaluate(request(of_kind("gradient"), {"f1", "f2", "theta"}, {0.4f, 0.45f, theta[2]}), &response)));
  const std::vector<float> by_theta = floats_of(response.results());
  EXPECT_NEAR(by_alpha[0], by_theta[0], 1e-6);
  EXPECT_NEAR(by_alpha[3], by_theta[3] * theta[3], 1e-4);
}

TEST_F(Operator, EvaluatesByNameAndOfBothLaws) {
  ASSERT_TRUE(ok(put("fold", bulge(0.8))));
  const std::vector<float> row{0.5f, 0.4f, 0.25f};
  v1::EvaluateOperatorResponse named, inlined, by_law;
  v1::EvaluateOperatorRequest by_name = request({}, {"f1", "f2", "theta"}, row);
  by_name.set_name("fold");
  ASSERT_TRUE(ok(evaluate(by_name, &named)));
  ASSERT_TRUE(ok(evaluate(request(bulge(0.8), {"f1", "f2", "theta"}, row), &inlined)));
  EXPECT_EQ(named.SerializeAsString(), inlined.SerializeAsString());
  for (const char* letter : {"f", "x"}) {
    v1::EvaluateOperatorRequest max =
        request({}, {std::string(letter) + "1", std::string(letter) + "2"}, {0.25f, 0.75f});
    max.set_name("max");
    ASSERT_TRUE(ok(evaluate(max, &by_law)));
    EXPECT_EQ(by_law.columns(2), std::string("dg_d") + letter + "2");
    EXPECT_EQ(floats_of(by_law.results()), (std::vector<float>{0.75f, 0, 1}));
  }
  // There may be no rows, and rows of doubles.
  ASSERT_TRUE(ok(evaluate(request(of_kind("max"), {"f1", "f2"}, {}), &by_law)));
  EXPECT_EQ(by_law.results().shape(0), 0u);
  v1::EvaluateOperatorRequest doubles = request(of_kind("max"), {"f1", "f2"}, {});
  const std::vector<double> numbers{0.5, 0.25};
  doubles.mutable_arguments()->set_dtype(v1::Tensor::FLOAT64);
  doubles.mutable_arguments()->set_shape(0, 1);
  doubles.mutable_arguments()->set_data(numbers.data(), 16);
  ASSERT_TRUE(ok(evaluate(doubles, &by_law)));
  EXPECT_EQ(floats_of(by_law.results())[0], 0.5f);
}

TEST_F(Operator, RefusesColumns) {
  const auto refused = [&](const v1::Operator& message, const std::vector<std::string>& columns,
                           const std::vector<std::string>& parts) {
    expect_refused(evaluate(request(message, columns, std::vector<float>(columns.size(), 0.25f))),
                   StatusCode::INVALID_ARGUMENT, parts);
  };
  refused(of_kind("gradient"), {"f1", "f2"}, {"columns = [f1, f2]", "one of theta and alpha"});
  refused(of_kind("gradient"), {"f1", "f2", "theta", "alpha"}, {"one of theta and alpha"});
  refused(of_kind("gradient"), {"f1", "theta"}, {"f1 and f2"});
  refused(of_kind("gradient"), {"x1", "x2", "theta"}, {"columns = [x1, x2, theta]", "f1 and f2"});
  refused(of_kind("max"), {"f1", "f2", "f1"}, {"each once"});
  refused(of_kind("max"), {"f1", "f2", "theta"}, {"columns = [f1, f2, theta]", "x1 and x2"});
  refused(of_kind("max"), {}, {"columns = []"});
  refused(of_kind("r_union"), {"f1", "f2"}, {"x1 and x2"});
  refused(of_kind("max"), {std::string(100'000, 'x')}, {"xxx..."});
  v1::Operator btk;
  for (const double r : {1.0, 2.0, 3.0}) btk.mutable_btk()->add_ranges(r);
  refused(btk, {"x1", "x2"}, {"x1 to x3"});
  refused(btk, {"x1", "x2", "x3", "x4"}, {"x1 to x3"});
  v1::Operator bt2;
  bt2.mutable_bt2()->set_r1(1);
  bt2.mutable_bt2()->set_r2(1);
  bt2.mutable_bt2()->set_eliminate_bulge(true);
  refused(bt2, {"x1", "x2"}, {"alpha", "optionally ratio"});
  EXPECT_TRUE(ok(evaluate(request(bt2, {"x1", "x2", "alpha"}, {1, 1, 1}))));
  EXPECT_TRUE(ok(evaluate(request(bt2, {"ratio", "x1", "x2", "alpha"}, {1, 1, 1, 1}))));
  v1::EvaluateOperatorRequest opening;
  opening.mutable_opening();
  set_rows({"theta"}, {0}, opening);
  expect_refused(evaluate(opening), StatusCode::INVALID_ARGUMENT, {"columns = [theta]", "alpha alone"});
  expect_refused(evaluate({}), StatusCode::INVALID_ARGUMENT, {"operator", "name"});
  v1::EvaluateOperatorRequest unknown = request({}, {"f1", "f2"}, {0, 0});
  unknown.set_name("nothing");
  expect_refused(evaluate(unknown), StatusCode::NOT_FOUND, {"'nothing'", "gradient"});
}

TEST_F(Operator, RefusesNumbersByRowAndColumn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const auto refused = [&](const std::string& kind, const std::vector<std::string>& columns,
                           const std::vector<float>& numbers, const std::vector<std::string>& parts) {
    expect_refused(evaluate(request(of_kind(kind), columns, numbers)), StatusCode::INVALID_ARGUMENT, parts);
  };
  refused("max", {"f1", "f2"}, {0, 0, 1, -0.25f}, {"arguments[1].f2 = -0.25", ">= 0"});
  refused("max", {"f1", "f2"}, {kInf, 0}, {"arguments[0].f1 = inf", "finite"});
  refused("max", {"f2", "f1"}, {0, kNan}, {"arguments[0].f1 = nan", "finite"});
  refused("r_union", {"x1", "x2"}, {-1, kNan}, {"arguments[0].x2 = nan", "finite"});
  refused("r_union", {"x1", "x2"}, {3e38f, 3e38f}, {"arguments[0].x1 = 3e+38", "at most 1e36"});
  refused("r_union", {"x1", "x2"}, {1, -3e38f}, {"arguments[0].x2 = -3e+38", "at most 1e36"});
  refused("sum", {"f1", "f2"}, {1, 2e36f}, {"arguments[0].f2 = 2e+36", "at most 1e36"});
  refused("gradient", {"f1", "f2", "theta"}, {0, 0, 0.8f}, {"arguments[0].theta = 0.8", "[0, pi/4]"});
  refused("gradient", {"f1", "f2", "theta"}, {0, 0, -0.1f}, {"arguments[0].theta = -0.1", "[0, pi/4]"});
  refused("gradient", {"f1", "f2", "alpha"}, {0, 0, 3.2f}, {"arguments[0].alpha = 3.2", "[0, pi]"});
  v1::EvaluateOperatorRequest bad = request(of_kind("max"), {"f1", "f2"}, {0, 0});
  bad.mutable_arguments()->set_dtype(v1::Tensor::UINT32);
  expect_refused(evaluate(bad), StatusCode::INVALID_ARGUMENT, {"arguments.dtype = UINT32", "FLOAT32"});
  bad = request(of_kind("max"), {"f1", "f2"}, {0, 0});
  bad.mutable_arguments()->set_shape(1, 3);
  expect_refused(evaluate(bad), StatusCode::INVALID_ARGUMENT, {"arguments.shape = [1, 3]", "[n, 2]"});
  bad = request(of_kind("max"), {"f1", "f2"}, {0, 0, 0});
  expect_refused(evaluate(bad), StatusCode::INVALID_ARGUMENT, {"arguments.data", "12 bytes", "8"});
  bad.mutable_arguments()->set_shape(0, std::uint64_t{1} << 62);
  expect_refused(evaluate(bad), StatusCode::RESOURCE_EXHAUSTED, {"rows a message"});
}

TEST(OperatorLimit, RefusesMoreOperatorsThanAdmitted) {
  Daemon daemon({"--max-operators", "1"});
  Peer peer(daemon.address());
  const auto put = [&](const std::string& name) {
    LimitedContext context;
    v1::PutOperatorRequest request;
    request.set_name(name);
    *request.mutable_operator_() = bulge(0.5);
    v1::PutOperatorResponse response;
    return peer.operators().PutOperator(&context, request, &response);
  };
  EXPECT_EQ(peer.info().limits().max_operators(), 1u);
  EXPECT_TRUE(ok(put("a")));
  EXPECT_TRUE(ok(put("a")));
  expect_refused(put("b"), StatusCode::RESOURCE_EXHAUSTED, {"1 custom operators", "delete"});
  EXPECT_EQ(peer.info().operators(), 1u);
}

}  // namespace
}  // namespace isofield::integration_test
