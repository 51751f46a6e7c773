// Tests that edits find fields by their names in the .proto file and in JSON, and that errors list the existing fields.
#include "blobtree/scene/parameter_edit.h"

#include <gtest/gtest.h>

#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::scene_of_nodes;

v1::Scene scene() {
  return scene_of_nodes(R"({"name": "bar", "segment": {"a": [0,0,0], "b": [1,0,0], "radius_a": 1, "radius_b": 1,
                                                       "range": 1}},
                           {"name": "all", "gradient": {"children": ["bar"], "opening": {"preset": "CAMEL"}}},
                           {"name": "pair", "superelliptic": {"children": ["all"], "exponent": 2, "ranges": [1, 2]}},
                           {"name": "sum", "sum": {"children": ["bar"]}})");
}

void expect_refused(const ParameterEdit& edit, const std::vector<std::string>& parts) {
  v1::Scene edited = scene();
  const std::string text(apply_edits({edit}, edited).status().message());
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
  }
  EXPECT_EQ(edited.SerializeAsString(), scene().SerializeAsString());
}

TEST(ParameterEdit, TakesTheNamesOfTheContractAndOfJson) {
  v1::Scene edited = scene();
  const std::vector<ParameterEdit> edits{
      {"bar", "radius_a", {2}}, {"bar", "radiusB", {3}}, {"#1", "opening.alpha0", {4}}};
  ASSERT_TRUE(apply_edits(edits, edited).ok());
  EXPECT_EQ(edited.nodes(0).segment().radius_a(), 2);
  EXPECT_EQ(edited.nodes(0).segment().radius_b(), 3);
  EXPECT_EQ(edited.nodes(1).gradient().opening().alpha0(), 4);
}

TEST(ParameterEdit, AWrongFieldIsToldWithTheNearestAndAll) {
  expect_refused({"bar", "radius_c", {1}},
                 {"bar.radius_c: a node of kind segment has no such numeric field", "did you mean 'radius_a'?",
                  "expected one of a, b, radius_a, radius_b, range"});
  expect_refused({"all", "opening.alfa0", {1}},
                 {"a node of kind gradient has no such", "did you mean 'opening.alpha0'?", "silhouette.k"});
  expect_refused({"all", "opening", {1}}, {"all.opening: a node of kind gradient has no such", "opening.theta0"});
  expect_refused({"all", "opening.preset", {1}}, {"has no such numeric field"});
  expect_refused({"pair", "byAngle", {1}}, {"has no such numeric field", "exponent, ranges, omega"});
  expect_refused({"bar", "a.x.y", {1}}, {"has no such numeric field"});
  expect_refused({"sum", "radius", {1}}, {"sum.radius: a node of kind sum has no numbers"});
  expect_refused({"baar", "range", {1}}, {"baar.range: no such node", "#0 to #3", "did you mean 'bar'?"});
  expect_refused({"bar", "a.w", {1}}, {"expected one number for one of the 3 elements"});
}

}  // namespace
}  // namespace isofield::blobtree
