// What the services admit; stated to clients by GetInfo.
#pragma once

#include <cstdint>

#include "blobtree/scene/scene.h"
#include "engine/points/evaluation_queue.h"
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
  engine::QueueLimits queue;
  SharedLimits shared;
};

}  // namespace isofield::rpc
