#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include "isofield/v1/operator.pb.h"
#include "operators/argument_columns.h"
#include "operators/parameters.h"

namespace isofield {
namespace {

void expect_refused(const absl::Status& status, const std::vector<std::string>& parts) {
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  for (const std::string& part : parts) EXPECT_TRUE(absl::StrContains(status.message(), part)) << status;
}

TEST(OperatorParameters, AreFoundInNestedMessages) {
  v1::GradientBlend m;
  for (const char* assignment : {"silhouette=bulge", "K=0.8", "Opening=ORGANIC", "theta0=12.5", "opening.W1=2",
                                 "form=difference", "volume=32"}) {
    const absl::Status status = set_parameter(assignment, m);
    EXPECT_TRUE(status.ok()) << status;
  }
  EXPECT_EQ(m.silhouette().kind(), v1::Silhouette::BULGE);
  EXPECT_EQ(m.silhouette().k(), 0.8);
  EXPECT_EQ(m.opening().preset(), v1::Opening::ORGANIC);
  EXPECT_EQ(m.opening().theta0(), 12.5);
  EXPECT_TRUE(m.opening().has_w1());
  EXPECT_EQ(m.form(), v1::DIFFERENCE);
  EXPECT_EQ(m.volume(), 32u);
}

TEST(OperatorParameters, TakeListsAndFlags) {
  v1::Btk m;
  ASSERT_TRUE(set_parameter("ranges=1,2.5, 3", m).ok());
  ASSERT_TRUE(set_parameter("ranges=4,5", m).ok()) << "stated again it is replaced";
  ASSERT_TRUE(set_parameter("eliminate_bulge=true", m).ok());
  ASSERT_EQ(m.ranges_size(), 2);
  EXPECT_EQ(m.ranges(1), 5);
  EXPECT_TRUE(m.eliminate_bulge());
  v1::BartheBlend barthe;
  ASSERT_TRUE(set_parameter("theta1=30", barthe).ok());
  EXPECT_EQ(barthe.theta1(), 30);
}

TEST(OperatorParameters, RefusalsSayWhatThereIs) {
  v1::GradientBlend m;
  expect_refused(set_parameter("radius=1", m), {"radius", "opening.theta0", "silhouette.k", "form"});
  expect_refused(set_parameter("silhouette=round", m), {"silhouette=round", "smooth, bulge, sampled"});
  expect_refused(set_parameter("preset=preset_unspecified", m), {"camel, organic, contact"});
  expect_refused(set_parameter("theta0=wide", m), {"theta0=wide", "a number"});
  expect_refused(set_parameter("volume=1.5", m), {"a whole number"});
  expect_refused(set_parameter("samples=1,1,1", m), {"opening.samples", "silhouette.samples"});
  expect_refused(set_parameter("silhouette.samples=1,x", m), {"numbers separated by commas"});
  expect_refused(set_parameter("children=a", m), {"one of the names"});
  expect_refused(set_parameter("theta0", m), {"NAME=VALUE"});
  expect_refused(set_parameter("=1", m), {"NAME=VALUE"});
  v1::Sum sum;
  expect_refused(set_parameter("k=1", sum), {"has none"});
}

TEST(OperatorParameters, AreDescribed) {
  const std::vector<Parameter> parameters = describe_parameters(v1::SuperellipticBlend());
  ASSERT_EQ(parameters.size(), 5u);
  EXPECT_EQ(parameters[0].name, "exponent");
  EXPECT_EQ(parameters[0].range.accepts, "a number within [1, 64]");
  EXPECT_EQ(parameters[0].range.otherwise, "") << "it must be stated";
  EXPECT_EQ(parameters[3].name, "omega");
  EXPECT_EQ(parameters[3].range.otherwise, "0.01");
  EXPECT_EQ(parameters[4].range.accepts, "one of union, intersection, difference");
  EXPECT_TRUE(describe_parameters(v1::Sum()).empty());
}

TEST(OperatorParameters, AllHaveARange) {
  const auto* kinds = v1::Operator::descriptor()->FindOneofByName("kind");
  for (int i = 0; i < kinds->field_count(); ++i) {
    v1::Operator message;
    const auto& kind = *message.GetReflection()->MutableMessage(&message, kinds->field(i));
    for (const auto& [name, range] : describe_parameters(kind)) {
      EXPECT_NE(range.accepts, "") << kinds->field(i)->name() << "." << name;
    }
  }
}

TEST(OperatorParameters, TakeTheNamesOfJsonToo) {
  v1::SuperellipticBlend m;
  ASSERT_TRUE(set_parameter("byAngle=true", m).ok());
  EXPECT_TRUE(m.by_angle());
  v1::GradientBlend gradient;
  expect_refused(set_parameter("teta0=1", gradient), {"did you mean \"theta0\""});
  expect_refused(set_parameter("opening.teta0=1", gradient), {"did you mean \"opening.theta0\""});
  expect_refused(set_parameter("theta0=wide", gradient), {"degrees within [0, 45]"});
}

v1::Operator with_kind(const std::string& name) {
  v1::Operator message;
  message.GetReflection()->MutableMessage(&message, v1::Operator::descriptor()->FindFieldByName(name));
  return message;
}

using Names = std::vector<std::string>;

TEST(ArgumentColumns, AreThoseThatTheOperatorTakes) {
  EXPECT_EQ(*choose_columns(with_kind("gradient"), {"g", "theta", "f2", "f1"}), (Names{"f1", "f2", "theta"}));
  EXPECT_EQ(*choose_columns(with_kind("sampled"), {"f1", "f2", "alpha"}), (Names{"f1", "f2", "alpha"}));
  EXPECT_EQ(*choose_columns(with_kind("clean"), {"f1", "f2", "theta"}), (Names{"f1", "f2"}));
  EXPECT_EQ(*choose_columns(with_kind("max"), {"x1", "x2"}), (Names{"x1", "x2"}));
  EXPECT_EQ(*choose_columns(with_kind("max"), {"x1", "x2", "f1", "f2"}), (Names{"f1", "f2"}));
  EXPECT_EQ(*choose_columns(with_kind("btk"), {"x1", "x2", "x3", "h", "x5"}), (Names{"x1", "x2", "x3"}));
  v1::Operator bt2 = with_kind("bt2");
  EXPECT_EQ(*choose_columns(bt2, {"x1", "x2", "alpha"}), (Names{"x1", "x2"}));
  bt2.mutable_bt2()->set_eliminate_bulge(true);
  EXPECT_EQ(*choose_columns(bt2, {"ratio", "x1", "x2", "alpha"}), (Names{"x1", "x2", "alpha", "ratio"}));
}

TEST(ArgumentColumns, RefusalsSayWhatIsMissing) {
  expect_refused(choose_columns(with_kind("gradient"), {"f1", "f2"}).status(), {"f1, f2", "theta or alpha"});
  expect_refused(choose_columns(with_kind("gradient"), {"f1", "f2", "theta", "alpha"}).status(), {"not both"});
  expect_refused(choose_columns(with_kind("gradient"), {"x1", "x2", "theta"}).status(), {"f1 and f2"});
  expect_refused(choose_columns(with_kind("sum"), {"f1"}).status(), {"f1 and f2"});
  expect_refused(choose_columns(with_kind("pasko"), {"f1", "f2"}).status(), {"x1"});
  v1::Operator bt2 = with_kind("bt2");
  bt2.mutable_bt2()->set_eliminate_bulge(true);
  expect_refused(choose_columns(bt2, {"x1", "x2"}).status(), {"alpha"});
}

}  // namespace
}  // namespace isofield
