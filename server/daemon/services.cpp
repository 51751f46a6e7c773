#include "daemon/services.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "daemon/region_socket.h"

namespace isofield::daemon {
namespace {

// Returns the configured limits, with the limit of cells lowered to what the mesher can do on its device.
rpc::Limits limits_of(const Config& config, engine::Engine& engine) {
  rpc::Limits limits = config.limits;
  limits.max_mesh_cells = std::min(limits.max_mesh_cells, engine.mesher().max_cells());
  return limits;
}

std::unique_ptr<engine::CompileAhead> make_ahead(const Config& config,
                                                 std::shared_ptr<engine::SpecialisedKernels> specialised) {
  if (!config.compile_ahead) return nullptr;
  return std::make_unique<engine::CompileAhead>(gpu::DeviceOptions{.name = config.device}, config.limits.scene,
                                                std::move(specialised));
}

rpc::CallLog::Sink log_of_calls() {
  if (!spdlog::should_log(spdlog::level::debug)) return {};
  return [](const std::string& line) { spdlog::debug("{}", line); };
}

}  // namespace

Services::Services(const Config& config, const std::string& version, engine::Engine& engine,
                   std::shared_ptr<engine::SpecialisedKernels> specialised)
    : limits_(limits_of(config, engine)),
      batches_(limits_.batches),
      requests_(limits_.requests),
      shared_regions_(limits_.shared),
      call_log_(log_of_calls()),
      catalog_(store_, limits_.max_scenes),
      operators_(store_, limits_.max_operators),
      residents_(engine),
      scenes_(catalog_, operators_, residents_, engine),
      ahead_(make_ahead(config, std::move(specialised))),
      editor_(catalog_, residents_, engine, ahead_.get()),
      scene_service_(catalog_, operators_, residents_, editor_, engine, requests_),
      operator_service_(operators_, scenes_, engine, limits_, requests_),
      field_service_(scenes_, engine, limits_, batches_, requests_, config.shared_memory ? &shared_regions_ : nullptr,
                     call_log_),
      mesh_service_(scenes_, editor_, engine, limits_, requests_),
      surface_service_(scenes_, engine, limits_, requests_),
      info_service_(operators_, residents_, engine, limits_, version, region_socket_path(config)),
      reflection_service_(names()) {}

std::vector<std::string> Services::names() {
  return {v1::FieldService::service_full_name(), v1::InfoService::service_full_name(),
          v1::MeshService::service_full_name(),  v1::OperatorService::service_full_name(),
          v1::SceneService::service_full_name(), v1::SurfaceService::service_full_name()};
}

std::vector<grpc::Service*> Services::all() {
  return {&scene_service_,   &operator_service_, &field_service_,     &mesh_service_,
          &surface_service_, &info_service_,     &reflection_service_};
}

}  // namespace isofield::daemon
