#include "rpc/info_service.h"

#include "base/status_macros.h"
#include "blobtree/tape/tape.h"

namespace isofield::rpc {

absl::Status InfoService::get(v1::GetInfoResponse& response) const {
  response.set_version(version_);
  fill_device(*response.mutable_device());
  fill_limits(*response.mutable_limits());
  response.set_shared_memory_socket(region_socket_);
  const scenes::ResidentScenes::Usage residents = residents_.usage();
  response.set_resident_scenes(residents.scenes);
  response.set_scene_bytes(residents.bytes);
  response.set_device_bytes(engine_.device().allocated_bytes());
  ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t operators, operators_.size());
  response.set_operators(operators);
  response.set_uptime_seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  return absl::OkStatus();
}

void InfoService::fill_device(v1::DeviceInfo& device) const {
  const gpu::DeviceDescription& d = engine_.device().description();
  device.set_name(d.name);
  device.set_driver(d.driver);
  device.set_vulkan_version(d.vulkan_version);
  device.set_type(d.type);
  device.set_subgroup_size(d.subgroup_size);
  device.set_max_buffer_bytes(d.max_buffer_bytes);
  for (const gpu::ProfileNumber& n : gpu::profile_numbers()) {
    v1::TuningNumber& number = *device.add_profile();
    number.set_name(n.name);
    number.set_value(n.of(engine_.device().profile()));
    number.set_unit(n.unit);
    number.set_meaning(n.meaning);
  }
}

void InfoService::fill_limits(v1::Limits& limits) const {
  limits.set_max_nodes(limits_.scene.max_nodes);
  limits.set_max_primitives(limits_.scene.max_primitives);
  limits.set_max_stack_depth(blobtree::kMaxStackDepth);
  limits.set_max_scenes(limits_.max_scenes);
  limits.set_max_message_bytes(limits_.max_message_bytes);
  limits.set_max_points_per_message(limits_.max_points_per_message);
  limits.set_max_grid_points(limits_.max_grid_points);
  limits.set_max_mesh_cells(limits_.max_mesh_cells);
  limits.set_max_queued_requests(limits_.batches.max_requests);
  limits.set_max_queued_points(limits_.batches.max_points);
  limits.set_max_running_requests(limits_.requests.max_requests);
  limits.set_max_running_points(limits_.requests.max_points);
  limits.set_max_operators(limits_.max_operators);
  if (region_socket_.empty()) return;
  limits.set_max_shared_regions(limits_.shared.max_regions);
  limits.set_max_shared_bytes(limits_.shared.max_bytes);
}

}  // namespace isofield::rpc
