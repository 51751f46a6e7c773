// What the services admit; stated to clients by GetInfo.
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
  // Open EvaluateStream calls: each holds the memory of some messages.
  int max_streams = 192;
  int max_tracked_meshes = 32;  // open TrackMesh calls, which hold threads too
  std::uint64_t max_message_bytes = 64u << 20;
  std::uint64_t max_points_per_message = 1u << 20;
  std::uint64_t max_grid_points = 1ull << 32;
  std::uint64_t max_mesh_cells = 1u << 25;
  // Evaluate calls that wait or run.
  AdmissionLimits batches{
      .max_requests = 1024, .max_points = 1u << 23, .flags = "--max-queued-requests, --max-queued-points"};
  // Other calls that are at work. By default there is room for more of them than there are threads, and for sixteen of
  // the largest grids.
  AdmissionLimits requests{
      .max_requests = 1024, .max_points = 1ull << 36, .flags = "--max-running-requests, --max-running-points"};
  SharedLimits shared;
};

}  // namespace isofield::rpc
