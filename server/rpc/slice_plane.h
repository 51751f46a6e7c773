// The samples that a SliceRequest asks for, with what it leaves out chosen after the scene.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "blobtree/tape.h"
#include "engine/slicer.h"
#include "isofield/v1/surface_service.pb.h"

namespace isofield::rpc {

// INVALID_ARGUMENT: a field is out of its range, or is left out though the scene's field is not bounded.
// RESOURCE_EXHAUSTED: more than `max_points` samples.
absl::StatusOr<engine::Plane> read_plane(const v1::SliceRequest& request, const blobtree::Tape& tape,
                                         std::uint64_t max_points);

}  // namespace isofield::rpc
