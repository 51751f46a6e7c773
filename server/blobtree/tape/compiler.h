// From a validated scene to its tape.
#pragma once

#include <absl/status/statusor.h>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Folds transforms into the leaves, and into the frames of operators that follow an angle; expands shared nodes, and
// orders operands so that few values wait on the stack. INVALID_ARGUMENT: more than kMaxStackDepth values would wait,
// or a transform takes a primitive out of the range of lengths. Uses no recursion.
absl::StatusOr<Tape> compile(const Scene& scene);

}  // namespace isofield::blobtree
