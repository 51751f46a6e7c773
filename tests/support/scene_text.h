// Scenes for tests, written as people write them.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <string>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::test_support {

// The Scene message of a proto3 JSON text. The process ends where the text is wrong: it is part of the test.
v1::Scene scene_message(const std::string& json);

// ... with `nodes` as the JSON list of nodes; the last is the root.
v1::Scene scene_of_nodes(const std::string& nodes);

// "#i".
std::string place(std::size_t i);

// Read and compiled; the process ends where that is refused.
blobtree::Scene read_or_die(const v1::Scene& message);
blobtree::Tape compile_or_die(const blobtree::Scene& scene);

}  // namespace isofield::test_support
