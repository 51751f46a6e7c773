// What the daemon can be told. One precedence: defaults < configuration file < environment < flags.
#pragma once

#include <optional>
#include <string>

#include "engine/kernels/kernel_cache.h"
#include "engine/points/evaluation_queue.h"
#include "rpc/limits.h"

namespace isofield::daemon {

struct Config {
  std::string listen = "127.0.0.1:50051";  // HOST:PORT or unix:PATH
  std::string data_dir;                    // empty: none
  std::string device;                      // part of a device's name; empty: the best
  bool validation = false;
  std::string log_level = "info";
  int drain_seconds = 10;
  int max_threads = 256;
  bool shared_memory = false;
  std::uint64_t hot_points = 1u << 20;  // 0: no kernel is written
  bool compile_ahead = true;            // compile what edited scenes are likely to need next
  std::size_t max_kernels = engine::KernelOptions{}.most;
  engine::QueueOptions queue;
  rpc::Limits limits;
};

// `config` is absent when the process should end at once with `exit_status`: after --help, --version, a usage error.
struct ParsedConfig {
  std::optional<Config> config;
  int exit_status = 0;
};
ParsedConfig parse_config(int argc, char** argv, const std::string& version);

}  // namespace isofield::daemon
