#include "daemon/daemon.h"

#include <absl/strings/str_cat.h>
#include <absl/synchronization/mutex.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/status_macros.h"
#include "daemon/server.h"
#include "daemon/services.h"
#include "engine/engine.h"

namespace isofield::daemon {
namespace {

void start_logging(const Config& config) {
  auto logger = spdlog::stderr_color_mt("isofieldd");
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %^%l%$ %v");
  logger->set_level(spdlog::level::from_str(config.log_level));
  spdlog::set_default_logger(std::move(logger));
}

// Tells Mesa to keep compiled shaders in the data folder, which is writable and survives the process, unless
// MESA_SHADER_CACHE_DIR is set. FAILED_PRECONDITION: the folder cannot be made.
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

}  // namespace

absl::Status run(const Config& config, const std::string& version) {
  // Debian's build of Abseil looks for deadlocks at every lock, also those of gRPC. That takes 3 % of a small call
  // (measured), so it is switched off.
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
  ISOFIELD_ASSIGN_OR_RETURN(const std::unique_ptr<engine::Engine> engine,
                            engine::Engine::create(options, config.limits.scene, config.queue, tier_two(config),
                                                   {.most = config.max_kernels, .specialised = specialised}));
  const gpu::DeviceDescription& d = engine->device().description();
  spdlog::info("isofieldd {} on {} ({}, Vulkan {})", version, d.name, d.driver, d.vulkan_version);

  Services services(config, version, *engine, specialised);
  ISOFIELD_ASSIGN_OR_RETURN(const std::unique_ptr<Server> server, Server::start(config, services));
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("{}: finishing running requests, for {} s at most", strsignal(signal), config.drain_seconds);
  std::thread([signals] {
    int again = 0;
    sigwait(&signals, &again);
    _exit(128 + again);
  }).detach();
  server->stop(std::chrono::seconds(config.drain_seconds));
  spdlog::info("stopped");
  return absl::OkStatus();
}

}  // namespace isofield::daemon
