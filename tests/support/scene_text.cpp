#include "support/scene_text.h"

#include <absl/strings/str_cat.h>
#include <google/protobuf/util/json_util.h>

#include <cstdio>
#include <cstdlib>

#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"

namespace isofield::test_support {
namespace {

void die_unless(bool ok, const std::string& message) {
  if (ok) return;
  std::fprintf(stderr, "a test's scene is refused: %s\n", message.c_str());
  std::abort();
}

}  // namespace

v1::Scene scene_message(const std::string& json) {
  v1::Scene scene;
  const auto status = google::protobuf::util::JsonStringToMessage(json, &scene);
  die_unless(status.ok(), status.ToString() + "\n" + json);
  return scene;
}

v1::Scene scene_of_nodes(const std::string& nodes) {
  return scene_message("{\"nodes\": [" + nodes + "]}");
}

std::string place(std::size_t i) {
  return absl::StrCat("#", i);
}

blobtree::Scene read_or_die(const v1::Scene& message) {
  absl::StatusOr<blobtree::Scene> scene = blobtree::read_scene(message);
  die_unless(scene.ok(), std::string(scene.status().message()));
  return *std::move(scene);
}

blobtree::Tape compile_or_die(const blobtree::Scene& scene) {
  absl::StatusOr<blobtree::Tape> tape = blobtree::compile(scene);
  die_unless(tape.ok(), std::string(tape.status().message()));
  return *std::move(tape);
}

}  // namespace isofield::test_support
