// The limits within which the services accept requests. GetInfo states them to clients.
#pragma once

#include <cstdint>

#include "blobtree/scene/scene.h"
#include "rpc/admission.h"
#include "rpc/shared_regions.h"

namespace isofield::rpc {

struct Limits {
  blobtree::SceneLimits scene;
  std::uint64_t max_scenes = 1'000;
  std::uint64_t max_operators = 10'000;  // custom ones
  // Open EvaluateStream calls are limited, since each holds the memory of some messages.
  int max_streams = 192;
  int max_tracked_meshes = 32;  // open TrackMesh calls, each of which also holds a thread
  std::uint64_t max_message_bytes = 64u << 20;
  std::uint64_t max_points_per_message = 1u << 20;
  std::uint64_t max_grid_points = 1ull << 32;
  std::uint64_t max_mesh_cells = 1u << 25;
  // The limits of Evaluate calls that wait or run.
  AdmissionLimits batches{
      .max_requests = 1024, .max_points = 1u << 23, .flags = "--max-queued-requests, --max-queued-points"};
  // The limits of other calls at work. By default there is room for more calls than there are threads, and for sixteen
  // of the largest grids.
  AdmissionLimits requests{
      .max_requests = 1024, .max_points = 1ull << 36, .flags = "--max-running-requests, --max-running-points"};
  SharedLimits shared;
};

}  // namespace isofield::rpc
