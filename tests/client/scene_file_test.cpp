#include "isofield/scene_file.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <filesystem>

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
