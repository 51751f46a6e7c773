// compile() makes the tape of a validated scene.
#pragma once

#include <absl/status/statusor.h>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Folds transforms into the leaves, and into the frames of operators that follow an angle. It expands shared nodes, and
// orders operands so that few values wait on the stack. INVALID_ARGUMENT: more than kMaxStackDepth values would wait, a
// transform takes a primitive out of the range of lengths, or the weights of nested blends have too small a product.
// The function uses no recursion.
absl::StatusOr<Tape> compile(const Scene& scene);

}  // namespace isofield::blobtree
