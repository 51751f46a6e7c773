// Tests scenes that keep the operators with which they were put, openings from picked points, and the command line of
// both.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "integration/operator_fixture.h"
#include "integration/process.h"
#include "integration/temporary_directory.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr char kScene[] = R"(
  {"name": "left", "sphere": {"center": [-0.4, 0, 0], "radius": 0.6, "range": 0.6}},
  {"name": "right", "sphere": {"center": [0.4, 0, 0], "radius": 0.6, "range": 0.6}},
  {"name": "model", "custom": {"children": ["left", "right"], "operator": "fold"}})";

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

using KeptOperator = OperatorFixture;

TEST_F(KeptOperator, ScenesKeepTheOperatorsThatTheyWerePutWith) {
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

  // An edit keeps the operators.
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

  // Putting the scene again takes the changed operator.
  ASSERT_TRUE(ok(put("fold", bulge(0))));
  scene.mutable_nodes(0)->mutable_sphere()->set_radius(0.6);
  ASSERT_TRUE(ok(peer_.put("scene", scene)));
  EXPECT_TRUE(same_bits(values(named("scene")), second));
}

TEST_F(KeptOperator, PicksTheOpeningOfAPoint) {
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
  // The directions from the centres (-0.4, 0) and (0.4, 0) to the point are straight up, and up to the left.
  EXPECT_NEAR(picked.alpha(), std::atan2(0.8, 0.6) * 180 / std::numbers::pi, 1e-2);
  v1::PickOpeningResponse again;
  ASSERT_TRUE(ok(pick(inlined(scene), "#2", point, &again)));
  EXPECT_EQ(again.SerializeAsString(), picked.SerializeAsString());
  ASSERT_TRUE(ok(pick(named("scene"), "model", {0.4, 0, 0}, &picked)));
  EXPECT_EQ(picked.theta(), 45) << "clamped";
}

TEST_F(KeptOperator, RefusesPicks) {
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

TEST_F(KeptOperator, CommandLineKeepsEvaluatesAndDraws) {
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

}  // namespace
}  // namespace isofield::integration_test
