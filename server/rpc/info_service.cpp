#include "rpc/info_service.h"

#include "blobtree/tape/tape.h"

namespace isofield::rpc {

grpc::Status InfoService::GetInfo(grpc::ServerContext*, const v1::GetInfoRequest*, v1::GetInfoResponse* response) {
  response->set_version(version_);
  const gpu::DeviceDescription& d = engine_.device().description();
  v1::DeviceInfo& device = *response->mutable_device();
  device.set_name(d.name);
  device.set_driver(d.driver);
  device.set_vulkan_version(d.vulkan_version);
  device.set_type(d.type);
  device.set_subgroup_size(d.subgroup_size);
  device.set_max_buffer_bytes(d.max_buffer_bytes);
  v1::Limits& limits = *response->mutable_limits();
  limits.set_max_nodes(limits_.scene.max_nodes);
  limits.set_max_primitives(limits_.scene.max_primitives);
  limits.set_max_stack_depth(blobtree::kMaxStackDepth);
  limits.set_max_scenes(limits_.max_scenes);
  limits.set_max_message_bytes(limits_.max_message_bytes);
  limits.set_max_points_per_message(limits_.max_points_per_message);
  limits.set_max_grid_points(limits_.max_grid_points);
  limits.set_max_mesh_cells(limits_.max_mesh_cells);
  limits.set_max_queued_requests(limits_.queue.max_requests);
  limits.set_max_queued_points(limits_.queue.max_points);
  limits.set_max_operators(limits_.max_operators);
  if (!region_socket_.empty()) {
    limits.set_max_shared_regions(limits_.shared.max_regions);
    limits.set_max_shared_bytes(limits_.shared.max_bytes);
  }
  response->set_shared_memory_socket(region_socket_);
  const scenes::ResidentScenes::Usage residents = residents_.usage();
  response->set_resident_scenes(residents.scenes);
  response->set_scene_bytes(residents.bytes);
  response->set_device_bytes(engine_.device().allocated_bytes());
  response->set_operators(operators_.size());
  response->set_uptime_seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
