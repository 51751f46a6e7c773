#include "isofield/scene_file.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "nearest_name.h"
#include "test_support.h"

namespace isofield {
namespace {

TEST(SceneFile, JsonRoundTrip) {
  const auto scene = parse_scene_json(R"({"description": "a \"b\"", "unit": "mm",
    "nodes": [{"name": "s", "sphere": {"radius": 0.1, "range": 1e-3}},
              {"gradient": {"children": ["s", "#0"], "opening": {"preset": "ORGANIC", "alpha0": 3}}}]})",
                                      "x.json");
  ASSERT_TRUE(scene.ok()) << scene.status();
  const auto text = format_scene_json(*scene);
  ASSERT_TRUE(text.ok());
  EXPECT_EQ(parse_scene_json(*text, "y.json")->SerializeAsString(), scene->SerializeAsString()) << *text;
  EXPECT_EQ(parse_scene_json(*format_scene_json(v1::Scene()), "empty")->SerializeAsString(), "");
}

TEST(SceneFile, ErrorsNameFileAndPlace) {
  const auto syntax = parse_scene_json("{\n \"nodes\": [\n  {\"name\" \"a\"}\n ]\n}\n", "dir/x.json");
  EXPECT_EQ(syntax.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(absl::StartsWith(syntax.status().message(), "dir/x.json:3:11: ")) << syntax.status();
  const auto field = parse_scene_json(R"({"nodes": [{"sphere": {"radius": "big"}}]})", "x.json");
  EXPECT_TRUE(absl::StrContains(field.status().message(), "nodes[0].sphere.radius")) << field.status();
  const auto unknown = parse_scene_json(R"({"nodes": [{"ball": {}}]})", "x.json");
  EXPECT_TRUE(absl::StrContains(unknown.status().message(), "ball")) << unknown.status();
  for (const char* bad : {"", "[]", "{", "null x", "\xff\xfe"}) {
    EXPECT_FALSE(parse_scene_json(bad, "x.json").ok()) << bad;
  }
}

TEST(SceneFile, ErrorsNameTheNearestFieldAndItsPlace) {
  const struct {
    const char* text;
    std::vector<std::string> parts;
  } kBad[] = {
      {"{\"nodes\": [\n {\"sphere\": {\"radus\": 1}, \"name\": \"ball\"}]}",
       {"x.json:2:14: ", "nodes[0] 'ball'.sphere has no field \"radus\"", "did you mean \"radius\"?",
        "expected one of center, radius, range, law"}},
      {R"({"nodes": [{"spere": {}}]})", {"x.json:1:13: ", "nodes[0] has no field", "did you mean \"sphere\""}},
      {R"({"node": []})", {"x.json:1:2: ", "the scene has no field \"node\"", "did you mean \"nodes\""}},
      {R"({"nodes": [{"name": "g", "gradient": {"opening": {"presett": "CAMEL"}}}]})",
       {"nodes[0] 'g'.gradient.opening", "did you mean \"preset\""}},
      {R"({"nodes": [{"gradient": {"opening": {"preset": "CAMLE"}}}]})",
       {"nodes[0].gradient.opening.preset = \"CAMLE\"", "one of CAMEL, ORGANIC, CONTACT", "did you mean \"CAMEL\""}},
      {R"({"nodes": [{"sphere": {"law": "signed"}}]})", {"law = \"signed\"", "did you mean \"SIGNED\"?"}},
      {R"({"nodes": [{"name": "s", "sphere": {"radius": 1, "radius": 2}}]})", {"'s'.sphere.radius is stated twice"}},
      {R"({"nodes": [{"segment": {"radiusA": 1, "radius_a": 2}}]})", {"segment.radius_a is stated twice"}},
      {R"({"nodes": [{"sphere": {}, "box": {}}]})", {"nodes[0] has both sphere and box"}},
      {R"({"nodes": [{"sphere": 3}]})", {"nodes[0].sphere is not an object"}},
      {R"({"nodes": [{"sphere": {"radius": true}}]})", {"nodes[0].sphere.radius = true", "expected a number"}},
      {R"({"nodes": [{"sphere": {"center": [0, [1], 2]}}]})", {"center[1] = [", "expected a number"}},
      {R"({"nodes": [{"name": 3, "sphere": {}}]})", {"nodes[0].name = 3: expected a text in quotes"}},
      {R"({"nodes": [{"btk": {"eliminateBulge": 1}}]})", {"eliminateBulge = 1: expected true or false"}},
      {"[]", {"x.json:1:1: ", "is not an object"}},
      {"{\"nodes\": [}", {"x.json:1:12: ", "\"}\" where \"{\" was expected"}},
      {"{\"nodes\": [\n", {"x.json:2:1: ", "the text ends"}},
  };
  for (const auto& [text, parts] : kBad) {
    const auto scene = parse_scene_json(text, "x.json");
    ASSERT_FALSE(scene.ok()) << text;
    for (const std::string& part : parts) {
      EXPECT_TRUE(absl::StrContains(scene.status().message(), part)) << "'" << part << "' in: " << scene.status();
    }
  }
}

TEST(SceneFile, TakesWhatProtobufTakes) {
  for (const char* text :
       {R"({"nodes": [{"sphere": {"radius": "1.5", "range": 1e0, "law": "POSITIVE", "center": null}}]})",
        R"({"nodes": [{"segment": {"radius_a": 1, "radiusB": 2}}], "root": null, "unit": "\u00b5m \"x\""})",
        R"({"nodes": [{"sphere": {"law": 1}, "box": null}]})", "{}", " {\n} "}) {
    EXPECT_TRUE(parse_scene_json(text, "x.json").ok()) << parse_scene_json(text, "x.json").status();
  }
}

TEST(NearestName, IsFoundByFewChanges) {
  const std::vector<std::string> names{"radius", "range", "center"};
  EXPECT_EQ(nearest_name("radus", names), "radius");
  EXPECT_EQ(nearest_name("raduis", names), "radius");
  EXPECT_EQ(nearest_name("RADIUS", names), "radius");
  EXPECT_EQ(nearest_name("rnage", names), "range");
  EXPECT_EQ(nearest_name("colour", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(did_you_mean("centre", names), "; did you mean \"center\"?");
  EXPECT_EQ(nearest_name(std::string(1000000, 'x'), names), "");
}

TEST(SceneFile, ReadsFilesOfBothForms) {
  const TemporaryDirectory directory;
  v1::Scene scene;
  for (int i = 0; i < 100000; ++i) {
    auto& sphere = *scene.add_nodes()->mutable_sphere();
    sphere.add_center(0.1 * i);
    sphere.add_center(1.0 / 3);
    sphere.add_center(-i);
    sphere.set_radius(1);
    sphere.set_range(2);
  }
  const double start = processor_seconds();
  const auto json = read_scene_file(write_file(directory.path("a.json"), *format_scene_json(scene)));
  EXPECT_LT(processor_seconds() - start, 20);
  ASSERT_TRUE(json.ok()) << json.status();
  EXPECT_EQ(json->SerializeAsString(), scene.SerializeAsString());
  const auto binary = read_scene_file(write_file(directory.path("a.pb"), scene.SerializeAsString()));
  EXPECT_EQ(binary->SerializeAsString(), scene.SerializeAsString());
  for (const char* const name : {"a.PB", "a.pb.gz", "a.PB.GZ"}) {
    const auto named = read_scene_file(write_file(directory.path(name), scene.SerializeAsString()));
    EXPECT_TRUE(named.ok()) << named.status();
  }
  EXPECT_FALSE(read_scene_file(write_file(directory.path("b.pb"), "\xff\xff\xff rubbish")).ok());
  EXPECT_EQ(read_scene_file(directory.path("none.json")).status().code(), absl::StatusCode::kNotFound);
  EXPECT_FALSE(read_scene_file(directory.path("")).ok());
}

TEST(SceneFile, ExamplesAreScenes) {
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ISOFIELD_SOURCE_DIR) / "client" / "examples")) {
    if (entry.path().extension() != ".json") continue;
    const auto scene = read_scene_file(entry.path().string());
    EXPECT_TRUE(scene.ok()) << scene.status();
    ++scenes;
  }
  EXPECT_GE(scenes, 3);
}

}  // namespace
}  // namespace isofield
