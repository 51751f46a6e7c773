// Tests that bad scenes are refused with INVALID_ARGUMENT and a text that names node, field, value and what is
// expected, and that nothing is stored.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

struct BadScene {
  std::string what, nodes;
  std::vector<std::string> parts;
};
// Without this function GoogleTest would print the bytes.
void PrintTo(const BadScene& scene, std::ostream* out) {
  *out << scene.what;
}

std::string ball(const std::string& fields) {
  return absl::StrCat(R"({"name": "ball", "sphere": {)", fields, "}}");
}
std::string primitive(const std::string& kind, const std::string& fields) {
  return absl::StrCat(R"({"name": "part", ")", kind, R"(": {)", fields, "}}");
}
std::string over_ball(const std::string& kind, const std::string& fields) {
  return absl::StrCat(ball(R"("radius": 1, "range": 1)"), ", ", R"({"name": "top", ")", kind, R"(": {)", fields, "}}");
}
std::string opening(const std::string& fields) {
  return over_ball("gradient",
                   absl::StrCat(R"("children": ["ball", "ball"], "opening": {"preset": "CAMEL", )", fields, "}"));
}

// The scenes hold what is refused in a Blob-tree, as far as this version of the contract can say it.
const BadScene kBadScenes[] = {
    {"NoNodes", "", {"nodes", "at least 1"}},
    {"CycleOfOne", primitive("max", R"("children": ["part"])"), {"part", "cycle"}},
    {"CycleOfThree",
     primitive("max", R"("children": ["b"])") + R"(, {"name": "b", "sum": {"children": ["c"]}},
                                                     {"name": "c", "transform": {"child": "part"}})",
     {"'b'", "'c'", "cycle"}},
    {"UnknownReference", over_ball("sum", R"("children": ["ball", "bell"])"), {"top", "'bell'", "name"}},
    {"ReferenceBeyondTheNodes", over_ball("sum", R"("children": ["#7"])"), {"top", "'#7'", "#0 to #1"}},
    {"TransformOfNothing", over_ball("transform", R"("scale": [2])"), {"top", "child"}},
    {"SumOfNothing", over_ball("sum", ""), {"top", "children", "at least 1"}},
    {"MaxOfNothing", over_ball("max", ""), {"top", "children", "at least 1"}},
    {"MinOfNothing", over_ball("min", ""), {"top", "children", "at least 1"}},
    {"DifferenceOfOne", over_ball("difference", R"("children": ["ball"])"), {"top", "children", "at least 2"}},
    {"RicciOfNothing", over_ball("ricci", R"("exponent": 2)"), {"top", "children", "at least 1"}},
    {"BlendOfNothing", over_ball("gradient", ""), {"top", "children", "at least 1"}},
    {"NoKind", R"({"name": "part"})", {"part", "kind", "sphere"}},
    {"NameTwice", ball(R"("radius": 1, "range": 1)") + "," + ball(R"("radius": 1, "range": 1)"), {"ball", "already"}},
    {"NameWithHash", R"({"name": "#a", "sphere": {"radius": 1, "range": 1}})", {"#a", "name"}},
    {"NameWithDot", R"({"name": "a.b", "sphere": {"radius": 1, "range": 1}})", {"a.b", "name"}},
    {"RadiusZero", ball(R"("radius": 0, "range": 1)"), {"ball", "radius is missing or 0", "> 0"}},
    {"RadiusNegative", ball(R"("radius": -3, "range": 1)"), {"ball", "radius = -3", "> 0"}},
    {"RadiusNotANumber", ball(R"("radius": "NaN", "range": 1)"), {"ball", "radius = nan"}},
    {"RadiusInfinite", ball(R"("radius": "Infinity", "range": 1)"), {"ball", "radius = inf"}},
    {"RangeMissing", ball(R"("radius": 1)"), {"ball", "range is missing or 0", "> 0"}},
    {"RangeNegative", ball(R"("radius": 1, "range": -1)"), {"ball", "range = -1", "> 0"}},
    {"CenterNotFinite", ball(R"("center": [0, "-Infinity", 0], "radius": 1, "range": 1)"), {"ball", "center.y = -inf"}},
    {"CenterOfTwo", ball(R"("center": [0, 1], "radius": 1, "range": 1)"), {"ball", "center", "3 numbers"}},
    {"SegmentRadius",
     primitive("segment", R"("a": [0,0,0], "b": [1,0,0], "radius_a": 0, "radius_b": 1, "range": 1)"),
     {"part", "radius_a is missing or 0"}},
    {"SegmentWithoutEnd",
     primitive("segment", R"("a": [0,0,0], "radius_a": 1, "radius_b": 1, "range": 1)"),
     {"part", "b", "3 numbers"}},
    {"BoxHalfSize", primitive("box", R"("half_size": [1, -1, 1], "range": 1)"), {"part", "half_size.y = -1"}},
    {"BoxRounding",
     primitive("box", R"("half_size": [1, 1, 1], "rounding": 2, "range": 1)"),
     {"part", "rounding = 2", "[0, 1]"}},
    {"CylinderOfNoLength",
     primitive("cylinder", R"("a": [1,1,1], "b": [1,1,1], "radius": 1, "range": 1)"),
     {"part", "b", "differs"}},
    {"TorusAxis",
     primitive("torus", R"("axis": [0,0,0], "major_radius": 2, "minor_radius": 1, "range": 1)"),
     {"part", "axis", "not 0"}},
    {"TorusRadius",
     primitive("torus", R"("major_radius": -2, "minor_radius": 1, "range": 1)"),
     {"part", "major_radius = -2"}},
    {"EllipsoidAxes", primitive("ellipsoid", R"("semi_axes": [1, 1, 0], "range": 1)"), {"part", "semi_axes.z = 0"}},
    {"RicciExponent",
     over_ball("ricci", R"("children": ["ball"], "exponent": 0)"),
     {"top", "exponent is missing or 0", "[1, 64]"}},
    {"RicciExponentNotANumber",
     over_ball("ricci", R"("children": ["ball"], "exponent": "NaN")"),
     {"top", "exponent = nan", "[1, 64]"}},
    {"AlphasOutOfOrder", opening(R"("alpha0": 120)"), {"top", "opening.alpha", "120"}},
    {"AlphaBeyond180", opening(R"("alpha2": 181)"), {"top", "opening.alpha2 = 181", "[0, 180]"}},
    {"ThetaBeyond45", opening(R"("theta0": 50)"), {"top", "opening.theta0 = 50", "[0, 45]"}},
    {"ThetaNegative", opening(R"("theta2": -1)"), {"top", "opening.theta2 = -1", "[0, 45]"}},
    {"SlopeOutOfRange", opening(R"("w0": 0.01)"), {"top", "opening.w0 = 0.01", "[0.05, 20]"}},
    {"BulgeBeyondOne",
     over_ball("gradient", R"("children": ["ball"], "silhouette": {"kind": "BULGE", "k": 1.5})"),
     {"top", "silhouette.k = 1.5", "[0, 1]"}},
    {"ScaleZero", over_ball("transform", R"("child": "ball", "scale": [1, 0, 1])"), {"top", "scale", "invertible"}},
    {"MatrixSingular",
     over_ball("transform", R"("child": "ball", "matrix": [1,2,3,0, 2,4,6,0, 0,0,1,0])"),
     {"top", "matrix", "condition"}},
    {"MatrixNotFinite",
     over_ball("transform", R"("child": "ball", "matrix": [1,0,0,0, 0,1,0,"NaN", 0,0,1,0])"),
     {"top", "matrix.7 = nan"}},
    {"RotationAxis",
     over_ball("transform", R"("child": "ball", "rotation": [0,0,0,90])"),
     {"top", "rotation", "not 0"}},
};

class Refusal : public testing::TestWithParam<BadScene> {
 protected:
  Peer peer_{shared_daemon().address()};
};

TEST_P(Refusal, StoresNothing) {
  const v1::Scene scene = test_support::scene_of_nodes(GetParam().nodes);
  expect_refused(peer_.put("bad", scene), StatusCode::INVALID_ARGUMENT, GetParam().parts);
  EXPECT_TRUE(peer_.list().empty());
  // The inline scene is refused in the same words.
  const std::vector<float> point{0, 0, 0};
  expect_refused(peer_.evaluate(inlined(scene), point, false, nullptr), StatusCode::INVALID_ARGUMENT, GetParam().parts);
  ReceivedMesh mesh;
  expect_refused(peer_.mesh(mesh_request(inlined(scene), 0.1), &mesh), StatusCode::INVALID_ARGUMENT, GetParam().parts);
  expect_serving(shared_daemon().address());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Refusal, testing::ValuesIn(kBadScenes),
                         [](const auto& info) { return info.param.what; });

TEST(RefusalOfPut, LeavesTheSceneOfThatName) {
  Peer peer(shared_daemon().address());
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer.put("good", test_support::scene_of_nodes(R"({"sphere": {"radius": 1, "range": 1}})"), &summary)));
  expect_refused(peer.put("good", test_support::scene_of_nodes(R"({"sphere": {"radius": -1, "range": 1}})")),
                 StatusCode::INVALID_ARGUMENT, {"nodes[0]", "radius = -1"});
  v1::GetSceneResponse got;
  ASSERT_TRUE(ok(peer.get("good", &got)));
  EXPECT_EQ(got.summary().version(), summary.version());
  EXPECT_EQ(got.scene().nodes(0).sphere().radius(), 1);
  EXPECT_TRUE(ok(peer.remove("good")));
}

TEST(RefusalByLimit, NamesTheLimit) {
  Daemon daemon({"--max-nodes", "4", "--max-primitives", "3", "--max-message-bytes", "65536"});
  Peer peer(daemon.address());
  const std::string node = R"({"sphere": {"radius": 1, "range": 1}})";
  expect_refused(
      peer.put("a", test_support::scene_of_nodes(absl::StrCat(node, ",", node, ",", node, ",", node, ",", node))),
      StatusCode::INVALID_ARGUMENT, {"5 nodes", "at most 4"});
  expect_refused(peer.put("a", test_support::scene_of_nodes(
                                   absl::StrCat(node, R"(, {"sum": {"children": ["#0", "#0", "#0", "#0"]}})"))),
                 StatusCode::INVALID_ARGUMENT, {"nodes[1]", "4 primitives", "at most 3"});
  v1::Scene heavy = test_support::scene_of_nodes(node);
  heavy.set_description(std::string(70'000, 'x'));
  expect_refused(peer.put("a", heavy), StatusCode::RESOURCE_EXHAUSTED, {"larger than max", "65536"});
  EXPECT_TRUE(ok(peer.put("a", test_support::scene_of_nodes(node))));
  expect_serving(daemon.address());
}

}  // namespace
}  // namespace isofield::integration_test
