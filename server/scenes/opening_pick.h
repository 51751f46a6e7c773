// The opening angle that a picked point asks for ([G] section 4).
#pragma once

#include <absl/status/statusor.h>

#include "engine/engine.h"
#include "isofield/v1/operator_service.pb.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// INVALID_ARGUMENT: the point, the node, or a first field that is 0 at the point.
absl::Status pick_opening(const FoundScene& found, const v1::PickOpeningRequest& request, engine::Engine& engine,
                          v1::PickOpeningResponse& response);

}  // namespace isofield::rpc
