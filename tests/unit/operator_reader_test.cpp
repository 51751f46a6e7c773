// Tests why operators of messages are refused, and what accepted ones become.
#include "blobtree/scene/operator_reader.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blobtree/scene/scene_reader.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::scene_of_nodes;

v1::Operator with_silhouette(const std::vector<double>& samples) {
  v1::Operator message;
  for (const double s : samples) message.mutable_gradient()->mutable_silhouette()->add_samples(s);
  return message;
}

void expect_refused(const v1::Operator& message, const std::vector<std::string>& parts) {
  const auto op = read_operator(message);
  ASSERT_FALSE(op.ok());
  EXPECT_EQ(op.status().code(), absl::StatusCode::kInvalidArgument);
  const std::string text(op.status().message());
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
  }
}

TEST(OperatorReader, SampledSilhouettesNameTheSampleThatIsWrong) {
  expect_refused(with_silhouette({1, 1.1}), {"silhouette.samples", "2 numbers", "3 to 4096"});
  expect_refused(with_silhouette({1, 1.1, 1.01}), {"silhouette.samples[2] = 1.01", "1 at both ends"});
  expect_refused(with_silhouette({1, 1.2, 1.5, 1.2, 1}), {"silhouette.samples[1] = 1.2", "unit square"});
  expect_refused(with_silhouette({1, 1, 0.6, 1, 1}), {"silhouette.samples[2] = 0.6", "half of it"});
  expect_refused(with_silhouette({1, std::nan(""), 1}), {"silhouette.samples[1] = nan"});
  expect_refused(with_silhouette({1, 0.53, 0.72, 0.9, 1}), {"silhouette.samples["});
  v1::Operator message = with_silhouette({1, 1.1, 1});
  message.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
  expect_refused(message, {"silhouette.samples", "kind SAMPLED"});
  message = with_silhouette({1, 1.1, 1});
  message.mutable_gradient()->set_volume(32);
  expect_refused(message, {"volume = 32", "sampled silhouette"});
}

TEST(OperatorReader, SampledOpeningsAreCurvesThroughTheirSamples) {
  v1::Operator message;
  for (const double degrees : {45.0, 10.0, 0.0, 30.0, 40.0})
    message.mutable_gradient()->mutable_opening()->add_samples(degrees);
  const auto op = read_operator(message);
  ASSERT_TRUE(op.ok()) << op.status();
  const double degree = std::numbers::pi / 180;
  const operators::Opening& o = *(*op)->opening();
  EXPECT_NEAR(o.theta(0).v, 45 * degree, 1e-12);
  EXPECT_NEAR(o.theta(45 * degree).v, 10 * degree, 1e-12);
  EXPECT_NEAR(o.theta_min(), 0, 1e-12);
  EXPECT_EQ(o.theta(0).d1, 0);
  EXPECT_EQ(o.theta(180 * degree).d1, 0);
  // The curve is monotone between samples.
  for (double a = 90; a < 180; a += 1) EXPECT_LE(o.theta(a * degree).v, o.theta((a + 1) * degree).v + 1e-15);
  message.mutable_gradient()->mutable_opening()->add_samples(46);
  expect_refused(message, {"opening.samples[5] = 46", "[0, 45]"});
  message.mutable_gradient()->mutable_opening()->set_theta0(3);
  expect_refused(message, {"opening.samples", "not both"});
}

v1::Operator sampled(int size, const std::function<float(double, double, double)>& g) {
  v1::Operator message;
  message.mutable_sampled()->set_size(size);
  for (int k = 0; k < size; ++k) {
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const double last = size - 1;
        message.mutable_sampled()->add_values(g(i / last, j / last, k / last));
      }
    }
  }
  return message;
}

TEST(OperatorReader, SampledVolumesNameTheSampleThatIsWrong) {
  const auto blend = [](double a, double b, double t) {
    return static_cast<float>((1 - t) * std::hypot(a, b) + t * std::max(a, b));
  };
  EXPECT_TRUE(read_operator(sampled(5, blend)).ok());
  v1::Operator message = sampled(5, blend);
  message.mutable_sampled()->set_values(31, std::nanf(""));
  expect_refused(message, {"values[31] (f1 = 0.25, f2 = 0.25, theta = 11.25 degrees) = nan", "finite"});
  message = sampled(5, blend);
  message.mutable_sampled()->set_values(3, 0.7f);
  expect_refused(message, {"values[3] (f1 = 0.75, f2 = 0", "the other field where one is 0"});
  message = sampled(5, blend);
  message.mutable_sampled()->set_values(7, 0.9f);
  expect_refused(message, {"values[8]", "no less than at the sample before along f1"});
  message.mutable_sampled()->set_size(4);
  expect_refused(message, {"values = [125 numbers]", "64"});
  message.mutable_sampled()->set_size(129);
  expect_refused(message, {"size = 129", "[2, 128]"});
}

TEST(OperatorReader, ControlPointsNameTheOneThatIsWrong) {
  v1::Operator message;
  v1::FunctionalBlend& f = *message.mutable_functional();
  f.add_x(0);
  f.add_h(1);
  expect_refused(message, {"x = [1 numbers]", "2 to 256"});
  f.add_x(0);
  expect_refused(message, {"h = [1 numbers]", "2, one for each x"});
  f.add_h(0.5);
  expect_refused(message, {"x[1] = 0", "more than 0"});
  f.set_x(1, 1);
  f.set_h(1, std::nan(""));
  expect_refused(message, {"h[1] = nan", "finite"});
  f.set_h(1, 0);
  f.set_x(0, -0.5);
  expect_refused(message, {"x[0] = -0.5", "a number >= 0", "|f1 - f2|"});
  f.set_x(0, 1 - 1e-12);
  expect_refused(message, {"x[1] = 1", "by at least 1e-09"});
  f.set_x(0, 0);
  f.set_form(v1::DIFFERENCE);
  const auto op = read_operator(message);
  ASSERT_TRUE(op.ok()) << op.status();
  EXPECT_EQ((*op)->form, operators::Form::kDifference);
}

TEST(OperatorReader, RangedBlendsNameTheTermThatIsWrong) {
  v1::Operator message;
  v1::Btk& b = *message.mutable_btk();
  expect_refused(message, {"ranges is missing: expected one range"});
  b.add_ranges(1);
  b.add_ranges(-1);
  expect_refused(message, {"ranges[1] = -1", "length > 0"});
  b.set_ranges(1, 1);
  b.add_powers(1);
  expect_refused(message, {"powers[0] = 1", "]1, 64]"});
  b.set_powers(0, 2);
  for (int i = 0; i < 3; ++i) b.add_weights(1);
  expect_refused(message, {"ranges = [2 numbers]", "1 or 3"});
  v1::Operator conic;
  conic.mutable_bt2()->set_r1(1);
  conic.mutable_bt2()->set_r2(2);
  conic.mutable_bt2()->set_p(2);
  expect_refused(conic, {"p = 2", "below r1 r2 = 2", "by at least 1e-09 of it"});
  conic.mutable_bt2()->set_p(-3e14);
  expect_refused(conic, {"p = -3e+14", "at least -1e+14 times it", "float32", "the union"});
  for (const double p : {2 - 4e-9, -30.0, -1e14}) {
    conic.mutable_bt2()->set_p(p);
    EXPECT_TRUE(read_operator(conic).ok()) << p;
  }
  conic.mutable_bt2()->set_p(0);
  conic.mutable_bt2()->set_m2(0);
  expect_refused(conic, {"m2 = 0", "[0.001, 1000]"});
  conic.mutable_bt2()->set_m2(1);
  conic.mutable_bt2()->add_children("a");
  expect_refused(conic, {"bt2.children", "no children"});
}

TEST(OperatorReader, MixedLawsAreRefusedWithThePathOfTheNode) {
  const auto refused = [](const std::string& nodes, const std::vector<std::string>& parts) {
    const auto scene = read_scene(scene_of_nodes(nodes));
    ASSERT_FALSE(scene.ok());
    for (const std::string& part : parts) {
      EXPECT_NE(scene.status().message().find(part), std::string::npos) << part << " in: " << scene.status().message();
    }
  };
  const std::string balls = R"([{"name": "p", "sphere": {"radius": 1, "range": 1}},
                                {"name": "s", "sphere": {"radius": 1, "law": "SIGNED"}},)";
  refused(balls + R"({"name": "u", "sum": {"children": ["p", "s"]}}])",
          {"nodes[2] 'u'.children", "nodes[1] 's' yields a SIGNED field", "expected a POSITIVE one", "soften"});
  refused(balls + R"({"name": "u", "btk": {"children": ["s", "p"], "ranges": [1]}}])",
          {"nodes[2] 'u'.children", "'p' yields a POSITIVE field", "harden"});
  refused(balls + R"({"name": "u", "max": {"children": ["s", "p"]}}])", {"'p' yields a POSITIVE field"});
  refused(balls + R"({"soften": {"child": "p", "range": 1}}])", {"nodes[2].child", "expected a SIGNED one"});
  refused(balls + R"({"harden": {"child": "s"}}])", {"nodes[2].child", "expected a POSITIVE one"});
  refused(balls + R"({"soften": {"child": "s", "range": 0}}])", {"nodes[2].range is missing or 0"});
  refused(R"([{"sphere": {"radius": 1, "range": 1, "law": "SIGNED"}}])", {"range = 1", "SIGNED field has no range"});
  refused(balls + R"({"bt2": {"children": ["s"], "r1": 1, "r2": 1}}])", {"[1 child]", "exactly 2"});
  refused(balls + R"({"btk": {"children": ["s"], "ranges": [1]}}])", {"[1 child]", "2 to 16"});
  refused(balls + R"({"btk": {"children": ["s", "s"], "ranges": [1, 1, 1]}}])", {"[2 children]", "exactly 3"});
  refused(balls + R"({"custom": {"children": ["p", "p"], "operator": "mine"}}])",
          {"operator = 'mine'", "custom operator"});
  refused(balls + R"({"clean": {"children": ["p"], "form": "DIFFERENCE"}}])", {"[1 child]", "at least 2"});
  // A transform has the law of its child, so a scene with only signed nodes below the soften is accepted.
  EXPECT_TRUE(read_scene(scene_of_nodes(balls + R"({"name": "t", "transform": {"child": "s", "scale": [2]}},
      {"name": "d", "difference": {"children": ["t", "s"]}}, {"soften": {"child": "d", "range": 1}}])"))
                  .ok());
}

TEST(OperatorReader, ASceneUsesFourVolumesAtMost) {
  const auto blend = [](int i, const char* volume) {
    return absl::StrCat(R"({"name": "v)", i, R"(", "gradient": {"children": ["p", "p"], "volume": )", volume, "}},");
  };
  std::string nodes = R"([{"name": "p", "sphere": {"radius": 1, "range": 1}},)";
  int i = 0;
  for (const char* volume : {"16", "32", "64", "128", "16"}) nodes += blend(i++, volume);
  const std::string sum = R"({"sum": {"children": ["v0", "v1"]}}])";
  EXPECT_TRUE(read_scene(scene_of_nodes(nodes + sum)).ok());  // equal volumes count once
  nodes += blend(i, R"(16, "silhouette": {"kind": "BULGE", "k": 0.5})");
  const auto scene = read_scene(scene_of_nodes(nodes + sum));
  ASSERT_FALSE(scene.ok());
  EXPECT_NE(scene.status().message().find("nodes[6] 'v5'.volume: more than 4"), std::string::npos) << scene.status();
  EXPECT_FALSE(read_scene(scene_of_nodes(R"([{"name": "p", "sphere": {"radius": 1, "range": 1}},
      {"gradient": {"children": ["p", "p"], "volume": 17}}])"))
                   .ok());
}

TEST(OperatorReader, CustomNodesTakeTheOperatorOfTheTable) {
  v1::Operator message;
  message.mutable_ricci()->set_exponent(3);
  const auto op = read_operator(message);
  ASSERT_TRUE(op.ok());
  const auto scene = read_scene(scene_of_nodes(R"([{"name": "p", "sphere": {"radius": 1, "range": 1}},
      {"custom": {"children": ["p", "p"], "operator": "mine"}}])"),
                                {}, {{"mine", *op}});
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->nodes[1].op->as<operators::Ricci>()->exponent, 3);
}

}  // namespace
}  // namespace isofield::blobtree
