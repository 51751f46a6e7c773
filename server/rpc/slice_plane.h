// Reads from a SliceRequest which plane to sample, and where. Fields that it leaves out are chosen to suit the scene.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "blobtree/tape/tape.h"
#include "engine/surface/slicer.h"
#include "isofield/v1/surface_service.pb.h"

namespace isofield::rpc {

// INVALID_ARGUMENT: a field of the request is out of its range, or one is left out although the scene's field is not
// bounded. RESOURCE_EXHAUSTED: there are more than `max_points` samples.
absl::StatusOr<engine::Plane> read_plane(const v1::SliceRequest& request, const blobtree::Tape& tape,
                                         std::uint64_t max_points);

}  // namespace isofield::rpc
