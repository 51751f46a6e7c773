#include "daemon/daemon.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/synchronization/mutex.h>
#include <grpc/grpc.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "base/status_macros.h"
#include "catalog/catalog.h"
#include "catalog/memory_store.h"
#include "catalog/operator_catalog.h"
#include "daemon/region_socket.h"
#include "daemon/socket.h"
#include "engine/engine.h"
#include "rpc/admission.h"
#include "rpc/call_log.h"
#include "rpc/evaluate_calls.h"
#include "rpc/evaluate_streams.h"
#include "rpc/field_service.h"
#include "rpc/info_service.h"
#include "rpc/mesh_service.h"
#include "rpc/operator_service.h"
#include "rpc/reflection_service.h"
#include "rpc/scene_service.h"
#include "rpc/shared_regions.h"
#include "rpc/surface_service.h"
#include "rpc/unreadable_requests.h"
#include "scenes/resident_scenes.h"
#include "scenes/scene_editor.h"
#include "scenes/scene_source.h"

namespace isofield::daemon {
namespace {

void start_logging(const Config& config) {
  auto logger = spdlog::stderr_color_mt("isofieldd");
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %^%l%$ %v");
  logger->set_level(spdlog::level::from_str(config.log_level));
  spdlog::set_default_logger(std::move(logger));
}

// Mesa keeps compiled shaders in a folder of its own choice unless told; ours survives and is writable.
absl::Status prepare_data_dir(const std::string& data_dir) {
  if (data_dir.empty()) return absl::OkStatus();
  const std::filesystem::path shaders = std::filesystem::path(data_dir) / "shader-cache";
  std::error_code error;
  std::filesystem::create_directories(shaders, error);
  if (error) {
    return absl::FailedPreconditionError(absl::StrCat("--data-dir ", data_dir, ": ", error.message()));
  }
  setenv("MESA_SHADER_CACHE_DIR", shaders.c_str(), 0);
  return absl::OkStatus();
}

// Absolute, for clients may run in other folders; empty: no memory is shared.
std::string region_socket_path(const Config& config) {
  const std::string path = config.shared_memory ? unix_path(config.listen) : "";
  return path.empty() ? "" : std::filesystem::absolute(path).string() + ".shm";
}

std::string kernel_folder(const Config& config) {
  return config.data_dir.empty() ? "" : (std::filesystem::path(config.data_dir) / "kernels").string();
}

engine::TierTwoOptions tier_two(const Config& config) {
  return {.is_on = config.hot_points > 0, .hot_points = config.hot_points, .folder = kernel_folder(config)};
}

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  return set;
}

std::vector<std::string> service_names() {
  return {v1::FieldService::service_full_name(),   v1::InfoService::service_full_name(),
          v1::MeshService::service_full_name(),    v1::OperatorService::service_full_name(),
          v1::SceneService::service_full_name(),   v1::SurfaceService::service_full_name()};
}

// Serving; destroyed, the server goes after the calls.
struct Running {
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<rpc::EvaluateCalls> evaluate_calls;
  std::unique_ptr<rpc::EvaluateStreams> evaluate_streams;
  std::unique_ptr<RegionSocket> region_socket;  // null: no memory is shared
};

absl::StatusOr<Running> start_server(const Config& config, const std::vector<grpc::Service*>& services,
                                     rpc::FieldService& field_service, rpc::SharedRegions& regions,
                                     rpc::CallLog& call_log) {
  ISOFIELD_RETURN_IF_ERROR(check_listen_address(config.listen));
  if (config.shared_memory && region_socket_path(config).empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat("--shared-memory: expected --listen unix:PATH, not --listen ", config.listen));
  }
  std::unique_ptr<RegionSocket> region_socket;
  if (config.shared_memory) {
    ISOFIELD_ASSIGN_OR_RETURN(
        region_socket, RegionSocket::listen(region_socket_path(config), regions, config.limits.shared.max_regions));
  }
  // Held until the process ends: the last one to let go of gRPC waits for its pollers, which sleep for 10 s each where
  // a client was slow to read.
  grpc_init();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort(config.listen, grpc::InsecureServerCredentials(), &port);
  // Or a second daemon would share the port in silence.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.SetMaxReceiveMessageSize(static_cast<int>(config.limits.max_message_bytes));
  builder.SetMaxSendMessageSize(-1);
  grpc::ResourceQuota quota("isofieldd");
  quota.SetMaxThreads(config.max_threads);
  builder.SetResourceQuota(quota);
  for (grpc::Service* service : services) builder.RegisterService(service);
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  if (call_log.is_on()) interceptors.push_back(call_log.interceptors());
  interceptors.push_back(rpc::refuse_unreadable_requests());
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  auto evaluate_calls = std::make_unique<rpc::EvaluateCalls>(field_service, builder.AddCompletionQueue());
  auto evaluate_streams = std::make_unique<rpc::EvaluateStreams>(field_service, builder.AddCompletionQueue());
  std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  const bool is_unix = absl::StartsWith(config.listen, "unix:");
  if (!server || (!is_unix && port <= 0)) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config.listen,
                                               ": is the address this machine's, and free? (--listen HOST:PORT or "
                                               "unix:PATH)"));
  }
  // Clients may also ask for the health of one service by its name.
  for (const std::string& name : service_names()) server->GetHealthCheckService()->SetServingStatus(name, true);
  evaluate_calls->start(std::max(config.max_threads / 8, 2));
  evaluate_streams->start(std::max(config.max_threads / 8, 2));
  if (is_unix) {
    spdlog::info("listening on {}", config.listen);
  } else {
    spdlog::info("listening on {}:{}", config.listen.substr(0, config.listen.rfind(':')), port);
  }
  return Running{std::move(server), std::move(evaluate_calls), std::move(evaluate_streams), std::move(region_socket)};
}

}  // namespace

absl::Status run(const Config& config, const std::string& version) {
  // On in Debian's build of Abseil, and in every lock of gRPC's: 3 % of a small call.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  start_logging(config);
  ISOFIELD_RETURN_IF_ERROR(prepare_data_dir(config.data_dir));

  gpu::DeviceOptions options;
  options.name = config.device;
  options.validation = config.validation;
  options.on_validation_message = [](const std::string& message) { spdlog::error("Vulkan validation: {}", message); };
  const auto specialised = std::make_shared<engine::SpecialisedKernels>(kernel_folder(config));
  ISOFIELD_ASSIGN_OR_RETURN(
      const std::unique_ptr<engine::Engine> engine,
      engine::Engine::create(options, config.limits.scene, config.queue, tier_two(config),
                             {.most = config.max_kernels, .specialised = specialised}));
  const gpu::DeviceDescription& d = engine->device().description();
  spdlog::info("isofieldd {} on {} ({}, Vulkan {})", version, d.name, d.driver, d.vulkan_version);

  rpc::Limits limits = config.limits;
  limits.max_mesh_cells = std::min(limits.max_mesh_cells, engine->mesher().max_cells());
  catalog::MemoryStore store;
  catalog::Catalog catalog(store, limits.max_scenes);
  catalog::OperatorCatalog operators(store, limits.max_operators);
  scenes::ResidentScenes residents(*engine);
  const scenes::SceneSource scenes(catalog, operators, residents, *engine);
  std::optional<engine::CompileAhead> ahead;
  if (config.compile_ahead) ahead.emplace(gpu::DeviceOptions{.name = config.device}, config.limits.scene, specialised);
  scenes::SceneEditor editor(catalog, residents, *engine, ahead ? &*ahead : nullptr);
  rpc::Admission batches(limits.batches), requests(limits.requests);
  rpc::SceneService scene_service(catalog, operators, residents, editor, *engine, requests);
  rpc::OperatorService operator_service(operators, scenes, *engine, limits, requests);
  rpc::SharedRegions shared_regions(limits.shared);
  rpc::CallLog::Sink log_line;
  if (spdlog::should_log(spdlog::level::debug)) log_line = [](const std::string& line) { spdlog::debug("{}", line); };
  rpc::CallLog call_log(std::move(log_line));
  rpc::FieldService field_service(scenes, *engine, limits, batches, requests,
                                  config.shared_memory ? &shared_regions : nullptr, call_log);
  rpc::MeshService mesh_service(scenes, editor, *engine, limits, requests);
  rpc::SurfaceService surface_service(scenes, *engine, limits, requests);
  rpc::ReflectionService reflection_service(service_names());
  rpc::InfoService info_service(operators, residents, *engine, limits, version, region_socket_path(config));
  ISOFIELD_ASSIGN_OR_RETURN(const Running running, start_server(config,
                                                                {&scene_service, &operator_service, &field_service,
                                                                 &mesh_service, &surface_service, &info_service,
                                                                 &reflection_service},
                                                                field_service, shared_regions, call_log));
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("{}: finishing running requests, for {} s at most", strsignal(signal), config.drain_seconds);
  std::thread([signals] {
    int again = 0;
    sigwait(&signals, &again);
    _exit(128 + again);
  }).detach();
  running.server->GetHealthCheckService()->SetServingStatus(false);
  running.server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(config.drain_seconds));
  running.server->Wait();
  running.evaluate_calls->stop();
  running.evaluate_streams->stop();
  spdlog::info("stopped");
  return absl::OkStatus();
}

}  // namespace isofield::daemon
