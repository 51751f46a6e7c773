// Edits that leave all of a tape alone but the openings and silhouettes of gradient blends: what animates a blend
// ([G] Figs. 18 and 19) compiles nothing.
#pragma once

#include <absl/status/statusor.h>

#include <optional>
#include <vector>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// The tape of the `edited` scene, from that of the scene before, of which only numbers of `nodes` have changed; nothing
// when these are more than profiles of gradient blends. INVALID_ARGUMENT as read_scene says.
absl::StatusOr<std::optional<Tape>> edit_blends(const Tape& tape, const v1::Scene& edited,
                                                const std::vector<std::uint32_t>& nodes, const SceneLimits& limits);

}  // namespace isofield::blobtree
