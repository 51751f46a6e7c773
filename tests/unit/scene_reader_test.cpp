#include "blobtree/scene/scene_reader.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::scene_message;
using test_support::scene_of_nodes;

const std::string kBall = R"({"name": "ball", "sphere": {"radius": 1, "range": 1}})";

struct Refusal {
  const char* what;
  std::string nodes;
  // All of these must appear in the error: the node, the field, the value, what is expected.
  std::vector<std::string> parts;

  friend void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.what; }
};

void expect_refused(const v1::Scene& message, const std::vector<std::string>& parts, const SceneLimits& limits = {}) {
  const auto scene = read_scene(message, limits);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.status().code(), absl::StatusCode::kInvalidArgument);
  const std::string text(scene.status().message());
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
}

std::string sphere(const char* fields) {
  return absl::StrCat(R"({"name": "arm/s", "sphere": {)", fields, "}}");
}
std::string over_ball(const char* kind, const std::string& fields) {
  return absl::StrCat(kBall, R"(, {"name": "op", ")", kind, R"(": {)", fields, "}}");
}
std::string opening(const char* fields) {
  return over_ball("gradient", absl::StrCat(R"("children": ["ball"], "opening": {)", fields, "}"));
}
std::string transform(const char* fields) {
  return over_ball("transform", absl::StrCat(R"("child": "ball", )", fields));
}

class RefusedTest : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedTest, WithNodeFieldValueAndWhatIsExpected) {
  expect_refused(scene_of_nodes(GetParam().nodes), GetParam().parts);
}

const char* const kLengthExpected = "expected a length > 0";

const Refusal kRefusals[] = {
    {"RadiusZero", sphere(R"("radius": 0, "range": 1)"), {"nodes[0] 'arm/s'.radius is missing or 0", kLengthExpected}},
    {"RadiusAbsent", sphere(R"("range": 1)"), {"nodes[0] 'arm/s'.radius is missing or 0", kLengthExpected}},
    {"RangeAbsent", sphere(R"("radius": 1)"), {"nodes[0] 'arm/s'.range is missing or 0", kLengthExpected}},
    {"RadiusNegative", sphere(R"("radius": -2.5, "range": 1)"), {"'arm/s'.radius = -2.5", kLengthExpected}},
    {"RadiusNaN", sphere(R"("radius": "NaN", "range": 1)"), {"'arm/s'.radius = nan", kLengthExpected}},
    {"RadiusInfinite", sphere(R"("radius": "Infinity", "range": 1)"), {"'arm/s'.radius = inf", kLengthExpected}},
    {"RangeZero", sphere(R"("radius": 1, "range": 0)"), {"'arm/s'.range is missing or 0", kLengthExpected}},
    {"RangeNegative", sphere(R"("radius": 1, "range": -1)"), {"'arm/s'.range = -1", kLengthExpected}},
    {"CenterNaN", sphere(R"("radius": 1, "range": 1, "center": [0,"NaN",0])"), {"'arm/s'.center.y = nan", "finite"}},
    {"CenterTooFar", sphere(R"("radius": 1, "range": 1, "center": [0,0,2e9])"), {"'arm/s'.center.z = 2e+09", "1e+09"}},
    {"CenterOfTwo",
     sphere(R"("radius": 1, "range": 1, "center": [0,1])"),
     {"'arm/s'.center", "2 numbers", "3 numbers"}},
    {"SegmentRadiusB",
     R"({"segment": {"a": [0,0,0], "b": [1,0,0], "radius_a": 1, "range": 1}})",
     {"nodes[0].radius_b is missing or 0", kLengthExpected}},
    {"SegmentEndNaN",
     R"({"segment": {"a": [0,0,0], "b": ["NaN",0,0], "radius_a": 1, "radius_b": 1, "range": 1}})",
     {"nodes[0].b.x = nan", "finite"}},
    {"SegmentWithoutA",
     R"({"segment": {"b": [1,0,0], "radius_a": 1, "radius_b": 1, "range": 1}})",
     {"nodes[0].a is missing: expected 3 numbers"}},
    {"CylinderWithoutB",
     R"({"cylinder": {"a": [1,0,0], "radius": 1, "range": 1}})",
     {"nodes[0].b is missing: expected 3 numbers"}},
    {"BoxHalfSizeAbsent", R"({"box": {"range": 1}})", {"nodes[0].half_size is missing: expected 3 numbers"}},
    {"BoxHalfSizeZero",
     R"({"box": {"half_size": [1,0,1], "range": 1}})",
     {"nodes[0].half_size.y = 0", kLengthExpected}},
    {"BoxRoundingTooLarge",
     R"({"box": {"half_size": [1,0.5,1], "rounding": 0.6, "range": 1}})",
     {"nodes[0].rounding = 0.6", "[0, 0.5]"}},
    {"BoxRoundingNegative",
     R"({"box": {"half_size": [1,0.5,1], "rounding": -0.1, "range": 1}})",
     {"nodes[0].rounding = -0.1", "[0, 0.5]"}},
    {"CylinderOfNoLength",
     R"({"cylinder": {"a": [1,0,0], "b": [1,0,0], "radius": 1, "range": 1}})",
     {"nodes[0].b", "differs from a"}},
    {"CylinderRadius",
     R"({"cylinder": {"a": [1,0,0], "b": [2,0,0], "radius": -1, "range": 1}})",
     {"nodes[0].radius = -1", kLengthExpected}},
    {"TorusAxisZero",
     R"({"torus": {"axis": [0,0,0], "major_radius": 1, "minor_radius": 1, "range": 1}})",
     {"nodes[0].axis", "(0, 0, 0)", "not 0"}},
    {"TorusMinorRadius",
     R"({"torus": {"major_radius": 1, "range": 1}})",
     {"nodes[0].minor_radius is missing or 0", kLengthExpected}},
    {"EllipsoidAxis",
     R"({"ellipsoid": {"semi_axes": [1,1,-3], "range": 1}})",
     {"nodes[0].semi_axes.z = -3", kLengthExpected}},
    {"NoKind", R"({"name": "x"})", {"nodes[0] 'x'.kind is missing", "sphere"}},
    {"SumOfNothing", over_ball("sum", ""), {"nodes[1] 'op'.children is missing: expected at least 1 child"}},
    {"MaxOfNothing", over_ball("max", ""), {"nodes[1] 'op'.children is missing: expected at least 1 child"}},
    {"MinOfNothing", over_ball("min", ""), {"nodes[1] 'op'.children is missing: expected at least 1 child"}},
    {"RicciOfNothing", over_ball("ricci", R"("exponent": 2)"), {"'op'.children is missing: expected at least 1 child"}},
    {"GradientOfNothing", over_ball("gradient", ""), {"'op'.children is missing: expected at least 1 child"}},
    {"DifferenceOfOne",
     over_ball("difference", R"("children": ["ball"])"),
     {"nodes[1] 'op'.children", "[1 child]", "at least 2 children"}},
    {"RicciExponentAbsent",
     over_ball("ricci", R"("children": ["ball"])"),
     {"'op'.exponent is missing or 0", "[1, 64]"}},
    {"RicciExponentTooLarge",
     over_ball("ricci", R"("children": ["ball"], "exponent": 65)"),
     {"'op'.exponent = 65", "[1, 64]"}},
    {"RicciExponentNaN",
     over_ball("ricci", R"("children": ["ball"], "exponent": "NaN")"),
     {"'op'.exponent = nan", "[1, 64]"}},
    {"AlphaTooLarge", opening(R"("preset": "CAMEL", "alpha2": 181)"), {"'op'.opening.alpha2 = 181", "[0, 180]"}},
    {"AlphaNaN", opening(R"("preset": "CAMEL", "alpha2": "NaN")"), {"'op'.opening.alpha2 = nan", "[0, 180]"}},
    {"AlphasOutOfOrder",
     opening(R"("preset": "CAMEL", "alpha0": 100)"),
     {"'op'.opening.alpha1 = 90", "more than alpha0 = 100"}},
    {"AlphasEqual",
     opening(R"("preset": "CAMEL", "alpha2": 90)"),
     {"'op'.opening.alpha2 = 90", "more than alpha1 = 90"}},
    {"RampTooShort",
     opening(R"("preset": "CAMEL", "alpha0": 89.95)"),
     {"'op'.opening.alpha1 = 90", "more than alpha0 = 89.95, by 0.0572958 (a thousandth of a radian) or more"}},
    {"SecondRampTooShort",
     opening(R"("preset": "CAMEL", "alpha2": 90.05)"),
     {"'op'.opening.alpha2 = 90.05", "more than alpha1 = 90, by 0.0572958"}},
    {"ThetaTooLarge", opening(R"("preset": "CAMEL", "theta1": 46)"), {"'op'.opening.theta1 = 46", "[0, 45]"}},
    {"ThetaNegative", opening(R"("preset": "CAMEL", "theta0": -1)"), {"'op'.opening.theta0 = -1", "[0, 45]"}},
    {"SlopeTooSmall", opening(R"("preset": "CAMEL", "w0": 0.01)"), {"'op'.opening.w0 = 0.01", "[0.05, 20]"}},
    {"SlopeTooLarge", opening(R"("preset": "CAMEL", "w1": 21)"), {"'op'.opening.w1 = 21", "[0.05, 20]"}},
    {"OpeningWithoutPreset", opening(R"("alpha0": 10)"), {"'op'.opening.alpha1 is missing", "preset"}},
    {"OpeningPresetUnknown", opening(R"("preset": 17)"), {"'op'.opening.preset = 17", "CAMEL, ORGANIC or CONTACT"}},
    {"BulgeTooStrong",
     over_ball("gradient", R"("children": ["ball"], "silhouette": {"kind": "BULGE", "k": 1.5})"),
     {"'op'.silhouette.k = 1.5", "[0, 1]"}},
    {"SmoothWithStrength",
     over_ball("gradient", R"("children": ["ball"], "silhouette": {"k": 0.5})"),
     {"'op'.silhouette.k = 0.5", "BULGE"}},
    {"SilhouetteUnknown",
     over_ball("gradient", R"("children": ["ball"], "silhouette": {"kind": 9})"),
     {"'op'.silhouette.kind = 9", "SMOOTH, BULGE or SAMPLED"}},
    {"ScaleZero", transform(R"("scale": [1,0,1])"), {"'op'.scale", "invertible"}},
    {"ScaleOfTwo", transform(R"("scale": [1,2])"), {"'op'.scale", "2 numbers", "3 numbers"}},
    {"ScaleInfinite", transform(R"("scale": ["Infinity"])"), {"'op'.scale = inf", "finite"}},
    {"RotationOfThree", transform(R"("rotation": [0,0,1])"), {"'op'.rotation", "3 numbers", "4 numbers"}},
    {"RotationAxisZero", transform(R"("rotation": [0,0,0,20])"), {"'op'.rotation", "not 0"}},
    {"RotationAngleNaN", transform(R"("rotation": [0,0,1,"NaN"])"), {"'op'.rotation.3 = nan", "finite"}},
    {"TranslationNaN", transform(R"("translation": [0,0,"NaN"])"), {"'op'.translation.z = nan", "finite"}},
    {"MatrixSingular", transform(R"("matrix": [1,2,3,0, 4,5,6,0, 7,8,9,0])"), {"'op'.matrix", "condition", "1e+06"}},
    {"MatrixNearlySingular", transform(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1e-7,0])"), {"'op'.matrix", "condition"}},
    {"MatrixOfEleven",
     transform(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1])"),
     {"'op'.matrix", "11 numbers", "12 numbers"}},
    {"MatrixNaN", transform(R"("matrix": [1,0,0,0, 0,"NaN",0,0, 0,0,1,0])"), {"'op'.matrix.5 = nan", "finite"}},
    {"MatrixAndScale",
     transform(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0], "scale": [2])"),
     {"'op'.matrix", "not both"}},
    {"TransformOfNothing", over_ball("transform", ""), {"nodes[1] 'op'.child is missing", "#0 to #1"}},
    {"UnknownName",
     over_ball("sum", R"("children": ["bell"])"),
     {"nodes[1] 'op'", "'bell'", "expected a node's name", "did you mean 'ball'?"}},
    {"UnknownPlace", over_ball("sum", R"("children": ["#2"])"), {"nodes[1] 'op'", "'#2'", "#0 to #1"}},
    {"BadPlace", over_ball("sum", R"("children": ["#x"])"), {"nodes[1] 'op'", "'#x'", "#0 to #1"}},
    {"NegativePlace", over_ball("sum", R"("children": ["#-1"])"), {"nodes[1] 'op'", "'#-1'", "#0 to #1"}},
    {"SignedPlace", over_ball("sum", R"("children": ["#+0"])"), {"nodes[1] 'op'", "'#+0'", "#0 to #1"}},
    {"SpacedPlace", over_ball("sum", R"("children": ["# 0"])"), {"nodes[1] 'op'", "'# 0'", "#0 to #1"}},
    {"HugePlace", over_ball("sum", R"("children": ["#4294967296"])"), {"nodes[1] 'op'", "'#4294967296'"}},
    {"NameTwice", kBall + "," + kBall, {"nodes[1] 'ball'.name = 'ball'", "already", "nodes[0]"}},
    {"NameWithHash", R"({"name": "#1", "sphere": {"radius": 1, "range": 1}})", {"nodes[0] '#1'.name", "'#'"}},
    {"NameWithDot", R"({"name": "a.b", "sphere": {"radius": 1, "range": 1}})", {"nodes[0] 'a.b'.name", "'.'"}},
    {"CycleOfOne", R"({"name": "me", "sum": {"children": ["me"]}})", {"nodes[0] 'me'.children", "cycle"}},
    {"CycleOfTwo",
     R"({"name": "a", "sum": {"children": ["b"]}}, {"name": "b", "max": {"children": ["a"]}})",
     {"'a'", "'b'", "cycle"}},
    {"CycleThroughATransform",
     R"({"name": "a", "transform": {"child": "b"}}, {"name": "b", "max": {"children": ["a"]}})",
     {"'a'", "'b'", "cycle"}},
    {"CycleThatTheRootDoesNotReach",
     R"({"name": "a", "sum": {"children": ["b"]}}, {"name": "b", "max": {"children": ["a"]}}, )" + kBall,
     {"'a'", "'b'", "cycle"}},
    {"BadNodeThatTheRootDoesNotReach",
     sphere(R"("radius": 0, "range": 1)") + "," + kBall,
     {"'arm/s'.radius is missing or 0"}},
};

INSTANTIATE_TEST_SUITE_P(Scenes, RefusedTest, testing::ValuesIn(kRefusals),
                         [](const auto& info) { return std::string(info.param.what); });

TEST(SceneReader, EmptyScenesAreRefused) {
  expect_refused({}, {"nodes is missing", "at least 1 node"});
}

TEST(SceneReader, NamesAndTheUnitHaveAtMost256Bytes) {
  // These letters take two bytes each.
  std::string longest;
  for (int i = 0; i < 128; ++i) longest += "\xc3\xa9";
  v1::Scene scene = scene_of_nodes(kBall);
  scene.mutable_nodes(0)->set_name(longest);
  scene.set_unit(longest);
  EXPECT_TRUE(read_scene(scene).ok()) << read_scene(scene).status();
  scene.set_unit(longest + "m");
  expect_refused(scene, {"unit = ", "at most 256 bytes"});
  scene.clear_unit();
  scene.mutable_nodes(0)->set_name(longest + "m");
  expect_refused(scene, {"nodes[0]", ".name = ", "at most 256 bytes"});
}

TEST(SceneReader, UnknownRootsAreRefused) {
  expect_refused(scene_message("{\"nodes\": [" + kBall + "], \"root\": \"bell\"}"), {"root = 'bell'", "expected"});
  expect_refused(scene_message("{\"nodes\": [" + kBall + "], \"root\": \"#1\"}"), {"root = '#1'", "expected"});
}

TEST(SceneReader, TooManyNodesAreRefused) {
  expect_refused(scene_of_nodes(sphere(R"("radius": 1, "range": 1)") + "," + kBall), {"2 nodes", "at most 1"},
                 {.max_nodes = 1});
}

TEST(SceneReader, SharedNodesCountAtEveryUse) {
  // The sphere is doubled 60 times, so 61 nodes stand for 2^60 primitives.
  std::string nodes = kBall;
  for (int i = 0; i < 60; ++i) {
    absl::StrAppend(&nodes, R"(, {"sum": {"children": ["#)", i, R"(", "#)", i, R"("]}})");
  }
  expect_refused(scene_of_nodes(nodes), {"nodes[20]", "1048576 primitives", "at most 1000000"});
  expect_refused(scene_of_nodes(over_ball("sum", R"("children": ["ball","ball","ball"])")),
                 {"'op'", "3 primitives", "at most 2"}, {.max_primitives = 2});
  // Many operators over few primitives are counted, too.
  nodes = kBall;
  for (int i = 0; i < 20; ++i) absl::StrAppend(&nodes, R"(, {"sum": {"children": ["#)", i, R"("]}})");
  expect_refused(scene_of_nodes(nodes), {"nodes once shared"}, {.max_primitives = 2});
}

TEST(SceneReader, TooManyDifferentProfilesAreRefused) {
  const std::string bulges = kBall + R"(, {"gradient": {"children": ["#0"], "silhouette": {"kind": "BULGE", "k": 0.1}}},
      {"gradient": {"children": ["#1"], "silhouette": {"kind": "BULGE", "k": 0.2}}},
      {"gradient": {"children": ["#2"], "silhouette": {"kind": "BULGE", "k": 0.2}}})";
  EXPECT_TRUE(read_scene(scene_of_nodes(bulges), {.max_profiles = 3}).ok());
  // The first operator has the default opening, which the others share.
  expect_refused(scene_of_nodes(bulges), {"nodes[1].silhouette: more than 1 different"}, {.max_profiles = 1});
  expect_refused(scene_of_nodes(bulges), {"nodes[2].silhouette: more than 2 different"}, {.max_profiles = 2});
  const std::string openings = kBall + R"(, {"gradient": {"children": ["#0"]}},
      {"gradient": {"children": ["#1"], "opening": {"preset": "ORGANIC"}}})";
  expect_refused(scene_of_nodes(openings), {"nodes[2].opening: more than 2 different"}, {.max_profiles = 2});
  const std::string curves = R"({"sphere": {"radius": 1, "law": "SIGNED"}},
      {"functional": {"children": ["#0"], "x": [0, 1], "h": [0.5, 0]}},
      {"functional": {"children": ["#1"], "x": [0, 1], "h": [0.25, 0]}})";
  expect_refused(scene_of_nodes(curves), {"nodes[2].h: more than 1 different"}, {.max_profiles = 1});
}

TEST(SceneReader, ReferencesGoByNameAndPlaceInAnyOrder) {
  const auto scene = read_scene(scene_message(R"({"root": "top", "nodes": [
    {"name": "top", "sum": {"children": ["arm/s", "#1", "arm/s"]}}, {"max": {"children": ["#2"]}},
    {"name": "arm/s", "sphere": {"radius": 1, "range": 1}}, {"sphere": {"radius": 1, "range": 1}}]})"));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->root, 0u);
  EXPECT_EQ(scene->nodes[0].children, (std::vector<std::uint32_t>{2, 1, 2}));
  EXPECT_EQ(scene->order, (std::vector<std::uint32_t>{2, 1, 0}));  // children first; the last node is not reached
}

TEST(SceneReader, TheLastNodeIsTheRootOtherwise) {
  const auto scene = read_scene(scene_of_nodes(kBall + "," + sphere(R"("radius": 1, "range": 1)")));
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene->root, 1u);
}

TEST(SceneReader, DefaultsAndPresetsAreFilledIn) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto scene = read_scene(scene_of_nodes(
      kBall +
      R"(, {"torus": {"major_radius": 1, "minor_radius": 0.5, "range": 1}}, {"gradient": {"children": ["#0","#1"]}},
      {"gradient": {"children": ["#2","#1"], "opening": {"preset": "ORGANIC", "alpha2": 150, "theta0": 10},
                    "silhouette": {"kind": "BULGE", "k": 0.25}}},
      {"gradient": {"children": ["#3"], "opening": {"alpha0": 1, "alpha1": 2, "alpha2": 3, "theta0": 4, "theta1": 5,
                    "theta2": 6, "w0": 7, "w1": 8}}})"));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(*scene->nodes[2].op->opening(), operators::camel());
  EXPECT_EQ(scene->nodes[2].op->as<operators::Gradient>()->silhouette, operators::Silhouette{});
  const operators::Opening& o = *scene->nodes[3].op->opening();
  EXPECT_EQ(o.alpha1, operators::organic().alpha1);
  EXPECT_NEAR(o.alpha2, 150 * kDegree, 1e-15);
  EXPECT_NEAR(o.theta0, 10 * kDegree, 1e-15);
  EXPECT_EQ(scene->nodes[3].op->as<operators::Gradient>()->silhouette,
            (operators::Silhouette{operators::Silhouette::Kind::kBulge, 0.25}));
  EXPECT_NEAR(scene->nodes[4].op->opening()->theta2, 6 * kDegree, 1e-15);
  EXPECT_EQ(scene->nodes[4].op->opening()->w1, 8);
}

}  // namespace
}  // namespace isofield::blobtree
