// OperatorService: custom operators, evaluation of operators by themselves, openings from picked points; and scenes
// that keep the operators that they were put with.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "integration/daemon.h"
#include "integration/peer.h"
#include "integration/process.h"
#include "integration/temporary_directory.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr char kScene[] = R"(
  {"name": "left", "sphere": {"center": [-0.4, 0, 0], "radius": 0.6, "range": 0.6}},
  {"name": "right", "sphere": {"center": [0.4, 0, 0], "radius": 0.6, "range": 0.6}},
  {"name": "model", "custom": {"children": ["left", "right"], "operator": "fold"}})";

v1::Operator bulge(double k) {
  v1::Operator message;
  message.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CONTACT);
  message.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
  message.mutable_gradient()->mutable_silhouette()->set_k(k);
  return message;
}

v1::Operator of_kind(const std::string& name) {
  v1::Operator message;
  message.GetReflection()->MutableMessage(&message, v1::Operator::descriptor()->FindFieldByName(name));
  return message;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Operator : public testing::Test {
 protected:
  // Leaves the catalogs as they were found.
  void TearDown() override {
    for (const v1::SceneSummary& summary : peer_.list()) EXPECT_TRUE(ok(peer_.remove(summary.name())));
    for (const v1::OperatorSummary& summary : list()) {
      if (summary.version() != 0) {
        EXPECT_TRUE(ok(remove(summary.name())));
      }
    }
    EXPECT_TRUE(shared_daemon().is_running());
  }

  grpc::Status put(const std::string& name, const v1::Operator& message, v1::OperatorSummary* summary = nullptr) {
    return put(peer_, name, message, summary);
  }
  static grpc::Status put(Peer& peer, const std::string& name, const v1::Operator& message,
                          v1::OperatorSummary* summary = nullptr) {
    grpc::ClientContext context;
    v1::PutOperatorRequest request;
    request.set_name(name);
    *request.mutable_operator_() = message;
    v1::PutOperatorResponse response;
    const grpc::Status status = peer.operators().PutOperator(&context, request, &response);
    if (summary) *summary = response.summary();
    return status;
  }
  grpc::Status get(const std::string& name, v1::GetOperatorResponse* response) {
    grpc::ClientContext context;
    v1::GetOperatorRequest request;
    request.set_name(name);
    return peer_.operators().GetOperator(&context, request, response);
  }
  grpc::Status remove(const std::string& name) {
    grpc::ClientContext context;
    v1::DeleteOperatorRequest request;
    request.set_name(name);
    v1::DeleteOperatorResponse response;
    return peer_.operators().DeleteOperator(&context, request, &response);
  }
  std::vector<v1::OperatorSummary> list() {
    grpc::ClientContext context;
    v1::ListOperatorsResponse response;
    EXPECT_TRUE(ok(peer_.operators().ListOperators(&context, {}, &response)));
    return {response.operators().begin(), response.operators().end()};
  }

  static v1::EvaluateOperatorRequest request(const v1::Operator& message, const std::vector<std::string>& columns,
                                             const std::vector<float>& numbers) {
    v1::EvaluateOperatorRequest request;
    *request.mutable_inline_() = message;
    set_rows(columns, numbers, request);
    return request;
  }
  static void set_rows(const std::vector<std::string>& columns, const std::vector<float>& numbers,
                       v1::EvaluateOperatorRequest& request) {
    request.mutable_columns()->Assign(columns.begin(), columns.end());
    v1::Tensor& tensor = *request.mutable_arguments();
    tensor.set_dtype(v1::Tensor::FLOAT32);
    tensor.clear_shape();
    tensor.add_shape(columns.empty() ? 0 : numbers.size() / columns.size());
    tensor.add_shape(columns.size());
    tensor.set_data(numbers.data(), numbers.size() * sizeof(float));
  }
  grpc::Status evaluate(const v1::EvaluateOperatorRequest& request, v1::EvaluateOperatorResponse* response = nullptr) {
    grpc::ClientContext context;
    v1::EvaluateOperatorResponse ignored;
    return peer_.operators().EvaluateOperator(&context, request, response ? response : &ignored);
  }
  grpc::Status pick(const v1::SceneRef& scene, const std::string& node, const std::vector<double>& point,
                    v1::PickOpeningResponse* response) {
    grpc::ClientContext context;
    v1::PickOpeningRequest request;
    *request.mutable_scene() = scene;
    request.set_node(node);
    request.mutable_point()->Assign(point.begin(), point.end());
    return peer_.operators().PickOpening(&context, request, response);
  }
  std::vector<float> values(const v1::SceneRef& scene) {
    std::vector<float> xyz, results;
    for (int i = 0; i < 900; ++i) xyz.push_back(static_cast<float>((i * 7919 % 200) - 100) / 80);
    EXPECT_TRUE(ok(peer_.evaluate(scene, xyz, true, &results)));
    return results;
  }

  Peer peer_{shared_daemon().address()};
};

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
            "btk sampled ");
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
  // Columns in another order than the engine's.
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
  // No rows, and rows of doubles.
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

TEST_F(Operator, ScenesKeepTheOperatorsThatTheyWerePutWith) {
  expect_refused(peer_.put("scene", test_support::scene_of_nodes(kScene)), StatusCode::INVALID_ARGUMENT,
                 {"nodes[2] 'model'.operator = 'fold'", "custom operator"});
  ASSERT_TRUE(ok(put("fold", bulge(0.8))));
  ASSERT_TRUE(ok(put("other", bulge(0.4))));
  v1::Scene scene = test_support::scene_of_nodes(kScene);
  ASSERT_TRUE(ok(peer_.put("scene", scene)));
  const std::vector<float> first = values(named("scene"));
  EXPECT_TRUE(same_bits(values(inlined(scene)), first));

  ASSERT_TRUE(ok(put("fold", bulge(0))));
  EXPECT_TRUE(same_bits(values(named("scene")), first));
  const std::vector<float> second = values(inlined(scene));
  EXPECT_FALSE(same_bits(second, first)) << "an inline scene takes the operator as it is now";
  ASSERT_TRUE(ok(remove("fold")));
  EXPECT_TRUE(same_bits(values(named("scene")), first));
  expect_refused(peer_.put("again", scene), StatusCode::INVALID_ARGUMENT, {"'fold'", "'other'"});
  expect_refused(peer_.evaluate(inlined(scene), std::vector<float>{0, 0, 0}, false, nullptr),
                 StatusCode::INVALID_ARGUMENT, {"'fold'"});

  // An edit carries the operators on.
  v1::EditParametersRequest edit;
  edit.set_name("scene");
  edit.add_edits()->set_node("left");
  edit.mutable_edits(0)->set_field("radius");
  edit.mutable_edits(0)->add_values(0.7);
  ASSERT_TRUE(ok(peer_.edit(edit)));
  const std::vector<float> edited = values(named("scene"));
  EXPECT_FALSE(same_bits(edited, first));
  ASSERT_TRUE(ok(put("fold", bulge(0.8))));
  scene.mutable_nodes(0)->mutable_sphere()->set_radius(0.7);
  EXPECT_TRUE(same_bits(values(inlined(scene)), edited));

  // Putting the scene again takes up the changed one.
  ASSERT_TRUE(ok(put("fold", bulge(0))));
  scene.mutable_nodes(0)->mutable_sphere()->set_radius(0.6);
  ASSERT_TRUE(ok(peer_.put("scene", scene)));
  EXPECT_TRUE(same_bits(values(named("scene")), second));
}

TEST_F(Operator, PicksTheOpeningOfAPoint) {
  ASSERT_TRUE(ok(put("fold", bulge(0.8))));
  const v1::Scene scene = test_support::scene_of_nodes(kScene);
  ASSERT_TRUE(ok(peer_.put("scene", scene)));
  const std::vector<double> point{-0.4, 0.6, 0};  // on the surface of "left"
  std::vector<float> f2;
  v1::Scene right = scene;
  right.set_root("right");
  ASSERT_TRUE(ok(peer_.evaluate(inlined(right), std::vector<float>{-0.4f, 0.6f, 0}, false, &f2)));
  v1::PickOpeningResponse picked;
  ASSERT_TRUE(ok(pick(named("scene"), "model", point, &picked)));
  EXPECT_NEAR(picked.f1(), 0.5, 1e-5);
  EXPECT_NEAR(picked.f2(), f2[0], 1e-6);
  EXPECT_NEAR(picked.theta(), std::atan(f2[0] / 0.5) * 180 / std::numbers::pi, 1e-3);
  // From the centres (-0.4, 0) and (0.4, 0) to the point: straight up, and up to the left.
  EXPECT_NEAR(picked.alpha(), std::atan2(0.8, 0.6) * 180 / std::numbers::pi, 1e-2);
  v1::PickOpeningResponse again;
  ASSERT_TRUE(ok(pick(inlined(scene), "#2", point, &again)));
  EXPECT_EQ(again.SerializeAsString(), picked.SerializeAsString());
  ASSERT_TRUE(ok(pick(named("scene"), "model", {0.4, 0, 0}, &picked)));
  EXPECT_EQ(picked.theta(), 45) << "clamped";
}

TEST_F(Operator, RefusesPicks) {
  ASSERT_TRUE(ok(put("fold", bulge(0.8))));
  const v1::SceneRef scene = inlined(test_support::scene_of_nodes(kScene));
  v1::PickOpeningResponse picked;
  const auto refused = [&](const std::string& node, const std::vector<double>& point,
                           const std::vector<std::string>& parts) {
    expect_refused(pick(scene, node, point, &picked), StatusCode::INVALID_ARGUMENT, parts);
  };
  refused("nothing", {0, 0, 0}, {"'nothing'", "#0 to #2"});
  refused("", {0, 0, 0}, {"node = ''"});
  refused("#7", {0, 0, 0}, {"'#7'", "#0 to #2"});
  refused("left", {0, 0, 0}, {"'left'", "0 children", "2"});
  refused("model", {0, 0}, {"point holds 2 numbers"});
  refused("model", {0, NAN, 0}, {"point[1] = nan"});
  refused("model", {5, 0, 0}, {"first", "0 there"});
  expect_refused(pick(named("nothing"), "model", {0, 0, 0}, &picked), StatusCode::NOT_FOUND, {"nothing"});
  expect_refused(pick({}, "model", {0, 0, 0}, &picked), StatusCode::INVALID_ARGUMENT, {"scene"});
}

TEST_F(Operator, CommandLineKeepsEvaluatesAndDraws) {
  TemporaryDirectory directory;
  const auto isofield = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {ISOFIELD_COMMAND, "--server", shared_daemon().address(), "operator"});
    return run(arguments);
  };
  write_file(directory.path("fold.json"), R"({"gradient": {"silhouette": {"kind": "BULGE", "k": 0.8}}})");
  Outcome outcome = isofield({"put", directory.path("fold.json")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  write_file(directory.path("p.csv"), "f1,f2,theta\n0.5,0.4,0.25\n0.3,0,0.25\n");
  const Outcome custom = isofield({"eval", "fold", "--points", directory.path("p.csv")});
  EXPECT_EQ(custom.exit_code, 0) << custom.errors;
  EXPECT_EQ(custom.output.substr(0, 26), "g,dg_df1,dg_df2,dg_dtheta\n");
  EXPECT_NE(custom.output.find("\n0.300000012,1,"), std::string::npos) << custom.output;
  const Outcome built_in = isofield(
      {"eval", "gradient", "--param", "silhouette=bulge", "--param", "K=0.8", "--points", directory.path("p.csv")});
  EXPECT_EQ(built_in.output, custom.output) << built_in.errors;
  outcome = isofield({"eval", "fold", "--param", "k=2", "--points", directory.path("p.csv")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("silhouette.k = 2"), std::string::npos) << outcome.errors;
  for (const char* name : {"fold", "gradient", "opening"}) {
    outcome = isofield({"plot", name, "-o", directory.path("p.png"), "--size", "96"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(read_file(directory.path("p.png")).substr(1, 3), "PNG");
  }
  EXPECT_EQ(isofield({"rm", "fold"}).exit_code, 0);
  outcome = isofield({"show", "fold"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("'fold'"), std::string::npos) << outcome.errors;
}

TEST(OperatorLimit, RefusesMoreOperatorsThanAdmitted) {
  Daemon daemon({"--max-operators", "1"});
  Peer peer(daemon.address());
  const auto put = [&](const std::string& name) {
    grpc::ClientContext context;
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
