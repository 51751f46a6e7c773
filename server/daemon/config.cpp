#include "daemon/config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <vector>

namespace isofield::daemon {
namespace {

// What CLI11 parses, last argument first. It would let a file override the environment: that is stated as flags before
// the real ones, which override it.
std::vector<std::string> arguments_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : app.get_options()) {
    const std::string& variable = option->get_envname();
    const char* const value = variable.empty() ? nullptr : std::getenv(variable.c_str());
    if (value && *value) arguments.push_back("--" + option->get_lnames().front() + "=" + value);
  }
  arguments.insert(arguments.end(), argv + std::min(argc, 1), argv + argc);
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

}  // namespace

ParsedConfig parse_config(int argc, char** argv, const std::string& version) {
  Config c;
  int delay_us = 0;
  CLI::App app("isofieldd: keeps implicit surfaces on a GPU and answers fields and meshes over gRPC.", "isofieldd");
  app.option_defaults()->always_capture_default()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.set_version_flag("--version", "isofieldd " + version);
  app.set_config("--config", "", "Read options from a TOML or INI file");
  app.add_option("--listen", c.listen, "Address to serve: HOST:PORT (port 0: any free one) or unix:PATH")
      ->envname("ISOFIELD_LISTEN");
  app.add_option("--data-dir", c.data_dir, "Folder for what outlives the process: today the compiled kernels")
      ->envname("ISOFIELD_DATA_DIR");
  app.add_option("--device", c.device, "Part of the name of the Vulkan device to use; empty: the best one")
      ->envname("ISOFIELD_DEVICE");
  app.add_flag("--validation", c.validation, "Run under the Vulkan validation layer")->envname("ISOFIELD_VALIDATION");
  app.add_option("--log-level", c.log_level, "trace, debug, info, warn or error")
      ->envname("ISOFIELD_LOG_LEVEL")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error"}));
  app.add_option("--drain-seconds", c.drain_seconds, "How long running requests may take to finish on SIGTERM")
      ->envname("ISOFIELD_DRAIN_SECONDS")
      ->check(CLI::Range(0, 3600));
  app.add_option(
         "--max-threads", c.max_threads,
         "Threads, and so requests at once; Evaluate and EvaluateStream have an eighth as many of their own each, "
         "and three quarters as many streams may be open")
      ->envname("ISOFIELD_MAX_THREADS")
      ->check(CLI::Range(4, 65536));
  app.add_option("--hot-points", c.hot_points,
                 "Points evaluated of small scenes of one structure before a kernel is compiled for it; 0: never")
      ->envname("ISOFIELD_HOT_POINTS");
  app.add_option("--compile-ahead", c.compile_ahead,
                 "While a named scene is edited, compile in the background what it is likely to need next: true or false")
      ->envname("ISOFIELD_COMPILE_AHEAD");
  app.add_option("--max-kernels", c.max_kernels,
                 "Compiled kernels kept, some 0.25 MB each on lavapipe; beyond these the least recently used are freed")
      ->envname("ISOFIELD_MAX_KERNELS")
      ->check(CLI::Range(std::size_t{64}, std::size_t{65536}));
  app.add_option("--max-nodes", c.limits.scene.max_nodes, "Nodes of a scene")->envname("ISOFIELD_MAX_NODES");
  app.add_option("--max-primitives", c.limits.scene.max_primitives, "Primitives of a scene after instancing")
      ->envname("ISOFIELD_MAX_PRIMITIVES");
  app.add_option("--max-scenes", c.limits.max_scenes, "Scenes in the catalog")->envname("ISOFIELD_MAX_SCENES");
  app.add_option("--max-operators", c.limits.max_operators, "Custom operators in the catalog")
      ->envname("ISOFIELD_MAX_OPERATORS");
  app.add_option("--max-message-bytes", c.limits.max_message_bytes, "Bytes of a message received")
      ->envname("ISOFIELD_MAX_MESSAGE_BYTES")
      ->check(CLI::Range(std::uint64_t{65536}, std::uint64_t{1} << 30));
  app.add_option("--max-points-per-message", c.limits.max_points_per_message, "Points of one message")
      ->envname("ISOFIELD_MAX_POINTS_PER_MESSAGE")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 22));
  app.add_option("--max-grid-points", c.limits.max_grid_points, "Points of a grid request")
      ->envname("ISOFIELD_MAX_GRID_POINTS");
  app.add_option("--max-mesh-cells", c.limits.max_mesh_cells,
                 "Cells that a mesh request may look at, and as many as one without a cell size uses for thin parts; a "
                 "million take about 0.5 s of one core and 20 MB")
      ->envname("ISOFIELD_MAX_MESH_CELLS")
      ->check(CLI::Range(std::uint64_t{64}, std::uint64_t{1} << 30));
  app.add_option("--max-queued-requests", c.limits.queue.max_requests, "Evaluate calls that wait or run")
      ->envname("ISOFIELD_MAX_QUEUED_REQUESTS")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 20));
  app.add_option("--max-queued-points", c.limits.queue.max_points, "Points of Evaluate calls that wait or run")
      ->envname("ISOFIELD_MAX_QUEUED_POINTS")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
  app.add_option("--queue-delay-us", delay_us,
                 "Microseconds that a small Evaluate call may be held back for others to join it")
      ->envname("ISOFIELD_QUEUE_DELAY_US")
      ->check(CLI::Range(0, 1'000'000));
  app.add_flag("--shared-memory", c.shared_memory,
               "Share memory with clients of the same user; with --listen unix:PATH, by a second socket PATH.shm")
      ->envname("ISOFIELD_SHARED_MEMORY");
  app.add_option("--max-shared-regions", c.limits.shared.max_regions, "Regions of shared memory")
      ->envname("ISOFIELD_MAX_SHARED_REGIONS")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4096}));
  app.add_option("--max-shared-bytes", c.limits.shared.max_bytes, "Bytes of all regions of shared memory")
      ->envname("ISOFIELD_MAX_SHARED_BYTES");
  try {
    app.parse(arguments_of(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return {std::nullopt, status == 0 ? 0 : 2};
  }
  c.limits.queue.delay = std::chrono::microseconds(delay_us);
  c.limits.max_streams = c.max_threads * 3 / 4;
  c.limits.max_tracked_meshes = c.max_threads / 8;
  return {c, 0};
}

}  // namespace isofield::daemon
