// Tests SceneService: scenes by name and version, conditions, and edits of parameters.
#include <gtest/gtest.h>

#include <cstring>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

constexpr char kTwoBalls[] = R"(
  {"name": "left", "sphere": {"center": [-0.5, 0, 0], "radius": 0.6, "range": 0.4}},
  {"name": "right", "sphere": {"center": [0.5, 0, 0], "radius": 0.5, "range": 0.4}},
  {"name": "model", "gradient": {"children": ["left", "right"], "opening": {"preset": "CAMEL"}}})";

class Catalog : public testing::Test {
 protected:
  // Removes all scenes, so that the next test finds an empty catalog.
  void TearDown() override {
    for (const v1::SceneSummary& summary : peer_.list()) EXPECT_TRUE(ok(peer_.remove(summary.name())));
    EXPECT_TRUE(shared_daemon().is_running());
  }
  v1::EditParametersRequest edit_of(const std::string& node, const std::string& field,
                                    const std::vector<double>& values) {
    v1::EditParametersRequest request;
    request.set_name("scene");
    add_edit(request, node, field, values);
    return request;
  }
  static void add_edit(v1::EditParametersRequest& request, const std::string& node, const std::string& field,
                       const std::vector<double>& values) {
    v1::ParameterEdit& edit = *request.add_edits();
    edit.set_node(node);
    edit.set_field(field);
    edit.mutable_values()->Assign(values.begin(), values.end());
  }
  std::vector<float> values(const v1::SceneRef& scene) {
    test_support::Random random(4);
    std::vector<float> xyz, results;
    for (int i = 0; i < 6000; ++i) xyz.push_back(static_cast<float>(random.number(-2, 2)));
    EXPECT_TRUE(ok(peer_.evaluate(scene, xyz, true, &results)));
    return results;
  }

  Peer peer_{shared_daemon().address()};
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(Catalog, KeepsWhatWasPutUntilItIsDeleted) {
  const v1::Scene scene = test_support::scene_of_nodes(kTwoBalls);
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put("arm/upper-1.b_c", scene, &summary)));
  EXPECT_EQ(summary.name(), "arm/upper-1.b_c");
  EXPECT_GT(summary.version(), 0u);
  EXPECT_EQ(summary.nodes(), 3u);
  EXPECT_EQ(summary.primitives(), 2u);
  EXPECT_GT(summary.device_bytes(), 0u);
  ASSERT_EQ(summary.support_min_size(), 3);
  EXPECT_NEAR(summary.support_min(0), -1.5, 1e-5);
  EXPECT_NEAR(summary.support_max(0), 1.4, 1e-5);
  EXPECT_NEAR(summary.support_max(2), 1, 1e-5);

  v1::GetSceneResponse got;
  ASSERT_TRUE(ok(peer_.get("arm/upper-1.b_c", &got)));
  EXPECT_EQ(got.scene().SerializeAsString(), scene.SerializeAsString());
  EXPECT_EQ(got.summary().SerializeAsString(), summary.SerializeAsString());
  ASSERT_EQ(peer_.list().size(), 1u);
  EXPECT_EQ(peer_.list()[0].SerializeAsString(), summary.SerializeAsString());

  EXPECT_TRUE(ok(peer_.remove("arm/upper-1.b_c")));
  EXPECT_TRUE(peer_.list().empty());
  expect_refused(peer_.get("arm/upper-1.b_c", &got), StatusCode::NOT_FOUND, {"arm/upper-1.b_c"});
  expect_refused(peer_.remove("arm/upper-1.b_c"), StatusCode::NOT_FOUND, {"arm/upper-1.b_c"});
}

TEST_F(Catalog, ListsScenesByName) {
  const v1::Scene scene = Ball().scene();
  for (const char* name : {"c", "a", "b/x", "B"}) ASSERT_TRUE(ok(peer_.put(name, scene)));
  std::string names;
  for (const v1::SceneSummary& summary : peer_.list()) names += summary.name() + " ";
  EXPECT_EQ(names, "B a b/x c ");
}

TEST_F(Catalog, VersionsGrowWithEveryPutAndEditOfAnyScene) {
  const v1::Scene scene = test_support::scene_of_nodes(kTwoBalls);
  v1::SceneSummary summary;
  std::uint64_t last = 0;
  for (const char* name : {"scene", "other", "scene", "scene"}) {
    ASSERT_TRUE(ok(peer_.put(name, scene, &summary)));
    EXPECT_GT(summary.version(), last);
    last = summary.version();
  }
  ASSERT_TRUE(ok(peer_.edit(edit_of("left", "radius", {0.7}), &summary)));
  EXPECT_GT(summary.version(), last);
  last = summary.version();
  ASSERT_TRUE(ok(peer_.remove("scene")));
  ASSERT_TRUE(ok(peer_.put("scene", scene, &summary)));
  EXPECT_GT(summary.version(), last);
}

TEST_F(Catalog, PutsOnlyWhenTheConditionHolds) {
  v1::PutSceneRequest request;
  request.set_name("scene");
  *request.mutable_scene() = Ball().scene();
  request.set_version(7);
  expect_refused(peer_.put(request), StatusCode::NOT_FOUND, {"scene"});
  request.set_absent(true);
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put(request, &summary)));
  const std::uint64_t first = summary.version();
  *request.mutable_scene() = test_support::scene_of_nodes(kTwoBalls);
  expect_refused(peer_.put(request), StatusCode::ALREADY_EXISTS, {"scene", std::to_string(first)});
  request.set_version(first + 1000);
  expect_refused(peer_.put(request), StatusCode::ABORTED, {"scene", std::to_string(first)});
  v1::GetSceneResponse got;
  ASSERT_TRUE(ok(peer_.get("scene", &got)));
  EXPECT_EQ(got.summary().version(), first);
  EXPECT_EQ(got.scene().nodes_size(), 1);
  request.set_version(first);
  ASSERT_TRUE(ok(peer_.put(request, &summary)));
  EXPECT_EQ(summary.nodes(), 3u);
}

TEST_F(Catalog, RefusesNamesOutsideTheirLetters) {
  for (const std::string& name : {std::string(), std::string("a b"), std::string("\xc3\xa4"), std::string("a\nb"),
                                  std::string("#1"), std::string("a\\b"), std::string(129, 'x')}) {
    expect_refused(peer_.put(name, Ball().scene()), StatusCode::INVALID_ARGUMENT, {"name", "A-Z a-z 0-9 _ - . /"});
  }
  EXPECT_TRUE(ok(peer_.put(std::string(128, 'x'), Ball().scene())));
  EXPECT_TRUE(ok(peer_.put("../../etc/passwd", Ball().scene()))) << "a name is no path";
}

TEST_F(Catalog, EditsGiveTheSameBitsAsAFreshScene) {
  v1::Scene scene = test_support::scene_of_nodes(kTwoBalls);
  ASSERT_TRUE(ok(peer_.put("scene", scene)));
  const std::vector<float> before = values(named("scene"));
  v1::EditParametersRequest request = edit_of("left", "radius", {0.72});
  add_edit(request, "#1", "center", {0.55, 0.1, -0.2});
  add_edit(request, "right", "center.y", {0.15});
  add_edit(request, "right", "center.2", {-0.25});
  add_edit(request, "model", "opening.alpha0", {20});
  ASSERT_TRUE(ok(peer_.edit(request)));

  scene.mutable_nodes(0)->mutable_sphere()->set_radius(0.72);
  scene.mutable_nodes(1)->mutable_sphere()->mutable_center()->Clear();
  for (const double x : {0.55, 0.15, -0.25}) scene.mutable_nodes(1)->mutable_sphere()->add_center(x);
  scene.mutable_nodes(2)->mutable_gradient()->mutable_opening()->set_alpha0(20);
  v1::GetSceneResponse got;
  ASSERT_TRUE(ok(peer_.get("scene", &got)));
  EXPECT_EQ(got.scene().SerializeAsString(), scene.SerializeAsString());

  ASSERT_TRUE(ok(peer_.put("fresh", scene)));
  const std::vector<float> after = values(named("scene"));
  EXPECT_FALSE(same_bits(before, after));
  EXPECT_TRUE(same_bits(values(named("fresh")), after));
  EXPECT_TRUE(same_bits(values(inlined(scene)), after));
}

TEST_F(Catalog, EditsOfRandomScenesGiveTheSameBitsAsFreshOnes) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    v1::Scene scene = test_support::random_scene(seed, {.nodes = 30});
    ASSERT_TRUE(ok(peer_.put("scene", scene)));
    v1::EditParametersRequest request;
    request.set_name("scene");
    for (int i = 0; i < scene.nodes_size(); ++i) {
      if (!scene.nodes(i).has_sphere()) continue;
      const double radius = scene.nodes(i).sphere().radius() * 1.125;
      scene.mutable_nodes(i)->mutable_sphere()->set_radius(radius);
      add_edit(request, test_support::place(i), "radius", {radius});
    }
    ASSERT_TRUE(ok(peer_.edit(request)));
    EXPECT_TRUE(same_bits(values(named("scene")), values(inlined(scene)))) << "seed " << seed;
  }
}

TEST_F(Catalog, RefusedEditsLeaveTheSceneAsItWas) {
  const v1::Scene scene = test_support::scene_of_nodes(kTwoBalls);
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put("scene", scene, &summary)));
  const struct {
    const char *node, *field;
    std::vector<double> values;
    std::vector<std::string> parts;
  } kBad[] = {
      {"middle", "radius", {1}, {"middle", "no such node"}},
      {"#3", "radius", {1}, {"#3", "#0 to #2"}},
      {"#-1", "radius", {1}, {"#-1"}},
      {"left", "length", {1}, {"left.length", "radius"}},
      {"left", "radius", {}, {"left.radius", "one number"}},
      {"left", "radius", {1, 2}, {"left.radius", "one number"}},
      {"left", "radius", {-1}, {"left", "radius = -1"}},
      {"left", "radius", {std::nan("")}, {"left", "radius = nan"}},
      {"left", "center", {1, 2}, {"left", "center", "3 numbers"}},
      {"left", "center.3", {1}, {"left.center.3"}},
      {"left", "center.x.y", {1}, {"left.center.x.y"}},
      {"left", "", {1}, {"left"}},
      {"model", "children", {1}, {"model.children"}},
      {"model", "opening", {1}, {"model.opening"}},
      {"model", "opening.preset", {1}, {"model.opening.preset"}},
      {"model", "opening.alpha0", {100}, {"model", "opening.alpha", "100"}},
      {"model", "opening.theta0", {46}, {"model", "opening.theta0 = 46", "[0, 45]"}},
      {"model", "silhouette.k", {0.5}, {"model", "silhouette.k = 0.5"}},
  };
  for (const auto& bad : kBad) {
    SCOPED_TRACE(std::string(bad.node) + "." + bad.field);
    // A good edit before the bad one must not stick.
    v1::EditParametersRequest request = edit_of("right", "radius", {0.9});
    add_edit(request, bad.node, bad.field, bad.values);
    expect_refused(peer_.edit(request), StatusCode::INVALID_ARGUMENT, bad.parts);
    v1::GetSceneResponse got;
    ASSERT_TRUE(ok(peer_.get("scene", &got)));
    EXPECT_EQ(got.scene().SerializeAsString(), scene.SerializeAsString());
    EXPECT_EQ(got.summary().version(), summary.version());
  }
  v1::EditParametersRequest request = edit_of("left", "radius", {0.9});
  request.set_expected_version(summary.version() + 1);
  expect_refused(peer_.edit(request), StatusCode::ABORTED, {"scene", std::to_string(summary.version())});
  request.set_name("nothing");
  expect_refused(peer_.edit(request), StatusCode::NOT_FOUND, {"nothing", "scene"});
  EXPECT_TRUE(same_bits(values(named("scene")), values(inlined(scene))));
  expect_serving(shared_daemon().address());
}

TEST_F(Catalog, EditsAtTheExpectedVersion) {
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put("scene", test_support::scene_of_nodes(kTwoBalls), &summary)));
  v1::EditParametersRequest request = edit_of("left", "radius", {0.9});
  request.set_expected_version(summary.version());
  EXPECT_TRUE(ok(peer_.edit(request)));
  expect_refused(peer_.edit(request), StatusCode::ABORTED, {"scene"});
}

TEST_F(Catalog, EveryByteOnTheDeviceIsReturned) {
  const std::uint64_t before = peer_.info().device_bytes();
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put("scene", test_support::scene_of_nodes(kTwoBalls), &summary)));
  v1::GetInfoResponse info = peer_.info();
  EXPECT_EQ(info.resident_scenes(), 1u);
  EXPECT_EQ(info.scene_bytes(), summary.device_bytes());
  EXPECT_GE(info.device_bytes(), before + summary.device_bytes());
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(ok(peer_.put("scene", test_support::scene_of_nodes(kTwoBalls))));
  EXPECT_EQ(peer_.info().scene_bytes(), summary.device_bytes());
  values(inlined(Ball().scene()));
  EXPECT_EQ(peer_.info().resident_scenes(), 1u) << "inline scenes do not stay";
  ASSERT_TRUE(ok(peer_.remove("scene")));
  info = peer_.info();
  EXPECT_EQ(info.resident_scenes(), 0u);
  EXPECT_EQ(info.device_bytes(), before);
}

TEST(CatalogLimit, RefusesMoreScenesThanAdmitted) {
  Daemon daemon({"--max-scenes", "2"});
  Peer peer(daemon.address());
  ASSERT_TRUE(ok(peer.put("a", Ball().scene())));
  ASSERT_TRUE(ok(peer.put("b", Ball().scene())));
  expect_refused(peer.put("c", Ball().scene()), StatusCode::RESOURCE_EXHAUSTED, {"2 scenes", "delete"});
  EXPECT_TRUE(ok(peer.put("b", Ball().scene()))) << "replacing needs no more room";
  EXPECT_EQ(peer.info().resident_scenes(), 2u);
  ASSERT_TRUE(ok(peer.remove("a")));
  EXPECT_TRUE(ok(peer.put("c", Ball().scene())));
}

}  // namespace
}  // namespace isofield::integration_test
