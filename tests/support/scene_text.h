// Reads scenes that tests write as JSON texts, as people write them.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <string>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::test_support {

// Returns the Scene message of a proto3 JSON text. A wrong text ends the process, because the text is part of the test.
v1::Scene scene_message(const std::string& json);

// Returns the Scene message with `nodes` as the JSON list of nodes; the last one is the root.
v1::Scene scene_of_nodes(const std::string& nodes);

// Returns "#i", which refers to node i.
std::string place(std::size_t i);

// Read or compile a scene. A refusal ends the process.
blobtree::Scene read_or_die(const v1::Scene& message);
blobtree::Tape compile_or_die(const blobtree::Scene& scene);

}  // namespace isofield::test_support
