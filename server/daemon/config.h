// The daemon's configuration, and the function that reads it. Each source overrides those before it: defaults, the
// configuration file, the environment, the command line.
#pragma once

#include <optional>
#include <string>

#include "engine/kernels/kernel_cache.h"
#include "engine/points/evaluation_queue.h"
#include "rpc/limits.h"

namespace isofield::daemon {

// The options of the daemon; `isofieldd --help` explains each of them.
struct Config {
  std::string listen = "127.0.0.1:50051";  // HOST:PORT or unix:PATH
  std::string data_dir;                    // the folder for compiled kernels; empty: none
  std::string device;                      // part of the device's name; empty: the best device
  bool validation = false;                 // run under the Vulkan validation layer
  std::string log_level = "info";
  int drain_seconds = 10;
  int max_threads = 256;
  bool shared_memory = false;
  // A kernel is written for small scenes of one structure after so many of their points are evaluated; 0: never.
  std::uint64_t hot_points = 1u << 20;
  bool compile_ahead = true;                               // compile what edited scenes are likely to need next
  std::size_t max_kernels = engine::KernelOptions{}.most;  // compiled kernels that are kept
  engine::QueueOptions queue;
  rpc::Limits limits;
};

// If `config` is absent, the process should end at once with `exit_status`: after --help, --version or a usage error.
struct ParsedConfig {
  std::optional<Config> config;
  int exit_status = 0;
};
// Reads the configuration from all its sources. It prints help, the version and usage errors itself.
ParsedConfig parse_config(int argc, char** argv, const std::string& version);

}  // namespace isofield::daemon
