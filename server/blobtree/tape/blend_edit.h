// edit_blends() changes a tape for edits that change nothing but openings and silhouettes of gradient blends. The
// animation of a blend ([G] Figs. 18 and 19) therefore compiles nothing.
#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <vector>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// Returns the tape of the `edited` scene. `tape` is the tape of the scene before, and only numbers of `nodes` have
// changed since. The result is empty if more than profiles of gradient blends have changed; the scene must then be
// compiled. INVALID_ARGUMENT: read_scene() would refuse the edited nodes.
absl::StatusOr<std::optional<Tape>> edit_blends(const Tape& tape, const v1::Scene& edited,
                                                const std::vector<std::uint32_t>& nodes, const SceneLimits& limits);

}  // namespace isofield::blobtree
