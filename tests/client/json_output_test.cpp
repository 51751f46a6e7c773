#include "json_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "isofield/v1/scene.pb.h"
#include "isofield/v1/scene_service.pb.h"

namespace isofield {
namespace {

TEST(JsonObject, KeepsTheOrderOfSetting) {
  JsonObject object;
  object.set("z", 1).set("a", "text").set("m", true).set("z", 2);
  EXPECT_EQ(object.text(), R"({"z":2,"a":"text","m":true})");
}

TEST(JsonObject, NumbersAreNumbers) {
  JsonObject object;
  object.set("large", UINT64_MAX).set("third", 1.0 / 3).set("one", 1.0).set("none", NAN).set("far", -INFINITY);
  EXPECT_EQ(object.text(),
            R"({"large":18446744073709551615,"third":0.3333333333333333,"one":1,"none":null,"far":null})");
}

TEST(JsonObject, MessagesKeepTheContractsOrderAndNames) {
  v1::SceneSummary summary;
  summary.set_device_bytes(1ull << 60);
  summary.add_support_min(-0.5);
  summary.set_name("a");
  EXPECT_EQ(JsonObject(summary).text(),
            R"({"name":"a","version":0,"nodes":0,"primitives":0,"device_bytes":1152921504606846976,)"
            R"("support_min":[-0.5],"support_max":[]})");
  v1::Node node;
  node.mutable_segment()->set_radius_a(1);
  node.mutable_segment()->set_law(v1::SIGNED);
  EXPECT_EQ(JsonObject(node).text(),
            R"({"name":"","segment":{"a":[],"b":[],"radius_a":1,"radius_b":0,"range":0,"law":"SIGNED"}})");
  v1::Tensor tensor;
  tensor.set_data("\x01\xff");
  tensor.add_shape(2);
  EXPECT_EQ(JsonObject(tensor).text(), R"({"dtype":"DTYPE_UNSPECIFIED","shape":[2],"data":"Af8=","numbers":[]})");
}

TEST(JsonObject, TextsAreAlwaysUtf8) {
  JsonObject object;
  object.set("a", std::string("\"\\\n\t\x01 \xc3\xbc \xff \xe2\x82 \xed\xa0\x80 \xf0\x9f\x98\x80"));
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(object.text(), "{\"a\":\"\\\"\\\\\\n\\u0009\\u0001 \xc3\xbc " + bad + " " + bad + bad + " " + bad + bad +
                               bad + " \xf0\x9f\x98\x80\"}");
}

}  // namespace
}  // namespace isofield
