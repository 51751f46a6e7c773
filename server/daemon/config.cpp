#include "daemon/config.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <absl/strings/strip.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/nearest_name.h"
#include "base/status_macros.h"
#include "daemon/config_file.h"

namespace isofield::daemon {
namespace {

// Accepts whole numbers within [least, most]. CLI11's own range accepts "5x" as a number, and does not say which kind
// of number it expects.
CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  const std::string range = absl::StrCat("within [", least, ", ", most, "]");
  return CLI::Validator(
      [range, least, most](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        if (absl::SimpleAtoi(text, &value) && value >= least && value <= most) return "";
        return absl::StrCat("expected a whole number ", range, ", not ", text.substr(0, 40));
      },
      range);
}

constexpr absl::string_view kPrefix = "ISOFIELD_";

// Holds all options, each with the environment variable that is named after it. CLI11 does not know the variables: it
// would let a file override them, and would not name them in errors.
class Options {
 public:
  explicit Options(const std::string& version)
      : app("isofieldd: keeps implicit surfaces on a GPU and answers fields and meshes over gRPC.", "isofieldd") {
    app.option_defaults()->always_capture_default()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_version_flag("--version", "isofieldd " + version);
    app.add_option("--config", config_path,
                   "TOML file of options: lines such as max-scenes = 100. An option of the environment overrides the "
                   "file, and one of the command line both");
    add("--listen", c.listen, "Address to serve: HOST:PORT (port 0: any free one) or unix:PATH");
    add("--data-dir", c.data_dir, "Folder for what outlives the process: the compiled kernels");
    add("--device", c.device, "Part of the name of the Vulkan device to use; empty: the best one");
    add_flag("--validation", c.validation, "Run under the Vulkan validation layer");
    add("--log-level", c.log_level, "trace, debug, info, warn or error")
        ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error"}));
    add("--drain-seconds", c.drain_seconds, "How long running requests may take to finish on SIGTERM")
        ->check(whole(0, 3600));
    add("--max-threads", c.max_threads,
        "Threads, and so requests at once; Evaluate and EvaluateStream have an eighth as many of their own each, and "
        "three quarters as many streams may be open")
        ->check(whole(4, 65536));
    add("--hot-points", c.hot_points,
        "Points evaluated of small scenes of one structure before a kernel is compiled for it; 0: never")
        ->check(whole(0, std::uint64_t{1} << 62));
    add_flag("--compile-ahead", c.compile_ahead,
             "While a named scene is edited, compile in the background the kernels that it is likely to need next; on, "
             "unless --compile-ahead=false is stated");
    add("--max-kernels", c.max_kernels,
        "Compiled kernels kept, some 0.25 MB each on lavapipe; beyond these the least recently used are freed")
        ->check(whole(64, 65536));
    add("--max-nodes", c.limits.scene.max_nodes, "Nodes of a scene")->check(whole(1, std::uint64_t{1} << 31));
    add("--max-primitives", c.limits.scene.max_primitives, "Primitives of a scene after instancing")
        ->check(whole(1, std::uint64_t{1} << 31));
    add("--max-scenes", c.limits.max_scenes, "Scenes in the catalog")->check(whole(0, std::uint64_t{1} << 32));
    add("--max-operators", c.limits.max_operators, "Custom operators in the catalog")
        ->check(whole(0, std::uint64_t{1} << 32));
    add("--max-message-bytes", c.limits.max_message_bytes, "Bytes of a message received")
        ->check(whole(65536, std::uint64_t{1} << 30));
    add("--max-points-per-message", c.limits.max_points_per_message, "Points of one message")
        ->check(whole(1, std::uint64_t{1} << 22));
    add("--max-grid-points", c.limits.max_grid_points, "Points of a grid request")
        ->check(whole(1, std::uint64_t{1} << 48));
    add("--max-mesh-cells", c.limits.max_mesh_cells,
        "Cells that a mesh request may look at, and as many as one without a cell size uses for thin parts; a million "
        "take about 0.5 s of one core and 20 MB")
        ->check(whole(64, std::uint64_t{1} << 30));
    add("--max-queued-requests", c.limits.batches.max_requests, "Evaluate calls that wait or run")
        ->check(whole(1, std::uint64_t{1} << 20));
    add("--max-queued-points", c.limits.batches.max_points, "Points of Evaluate calls that wait or run")
        ->check(whole(1, std::uint64_t{1} << 32));
    add("--max-running-requests", c.limits.requests.max_requests,
        "Calls at work other than Evaluate, EvaluateStream and TrackMesh; a further one is refused at once")
        ->check(whole(1, std::uint64_t{1} << 20));
    add("--max-running-points", c.limits.requests.max_points,
        "Points, rays, rows and cells of these calls; a call that comes alone may have more")
        ->check(whole(1, std::uint64_t{1} << 48));
    add("--queue-delay-us", delay_us, "Microseconds that a small Evaluate call may be held back for others to join it")
        ->check(whole(0, 1'000'000));
    add_flag("--shared-memory", c.shared_memory,
             "Share memory with clients of the same user; with --listen unix:PATH, by a second socket PATH.shm");
    add("--max-shared-regions", c.limits.shared.max_regions, "Regions of shared memory")->check(whole(1, 4096));
    add("--max-shared-bytes", c.limits.shared.max_bytes, "Bytes of all regions of shared memory")
        ->check(whole(1, std::uint64_t{1} << 48));
  }

  // An option that a file or the environment may set as well.
  struct Settable {
    CLI::Option* option;
    std::string name;      // "max-nodes"
    std::string variable;  // "ISOFIELD_MAX_NODES"
  };

  CLI::App app;
  Config c;
  int delay_us = 0;
  std::string config_path;
  std::vector<Settable> settable;

 private:
  CLI::Option* note(const std::string& flag, CLI::Option* option) {
    const std::string name(absl::StripPrefix(flag, "--"));
    settable.push_back(
        {option, name, absl::StrCat(kPrefix, absl::AsciiStrToUpper(absl::StrReplaceAll(name, {{"-", "_"}})))});
    return option;
  }
  template <class Value>
  CLI::Option* add(const std::string& flag, Value& value, const std::string& description) {
    return note(flag, app.add_option(flag, value, description));
  }
  void add_flag(const std::string& flag, bool& value, const std::string& description) {
    note(flag, app.add_flag(flag, value, description));
  }
};

// Parses the arguments, which CLI11 wants in reverse order.
void parse(Options& options, std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());
  options.app.parse(arguments);
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_min() == 0;
}

// Appends a setting as arguments of the command line. An option and its value are two arguments, since CLI11 takes
// "--device=" for an option without a value.
void append_setting(const CLI::Option& option, const std::string& name, const std::string& value,
                    std::vector<std::string>& arguments) {
  if (is_flag(option)) {
    arguments.push_back(absl::StrCat("--", name, "=", value));
  } else {
    arguments.insert(arguments.end(), {"--" + name, value});
  }
}

// Returns what is wrong with one setting by itself, in the form "expected ...", or "" if nothing is.
std::string fault_of(const std::string& name, const std::string& value) {
  Options options("");
  std::vector<std::string> arguments;
  append_setting(*options.app.get_option("--" + name), name, value, arguments);
  try {
    parse(options, arguments);
  } catch (const CLI::ConversionError&) {
    return "expected true or false";  // it is a flag, since a faulty number fails its check with another error
  } catch (const CLI::ParseError& error) {
    const std::string what = error.what();
    return std::string(absl::StripPrefix(what, absl::StrCat("--", name, ": ")));
  }
  return "";
}

// Checks that the line's value has the option's type. As in TOML, a number in quotes is a text.
absl::Status check_kind(const CLI::Option& option, const ConfigLine& line) {
  using Kind = ConfigLine::Kind;
  Kind wanted = Kind::kWholeNumber;
  const char* expected = "a whole number, without quotes";
  if (is_flag(option)) {
    wanted = Kind::kTruth;
    expected = "true or false, without quotes";
  } else if (absl::StartsWith(option.get_type_name(), "TEXT")) {
    wanted = Kind::kText;
    expected = "a text in quotes";
  }
  if (line.kind == wanted) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("expected ", expected));
}

// Returns the settings of the file as arguments of the command line. INVALID_ARGUMENT: a key is unknown, or a value is
// faulty.
absl::StatusOr<std::vector<std::string>> flags_of_file(const Options& options, const std::string& path) {
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<ConfigLine> lines, read_config_file(path));
  std::vector<std::string> names, flags;
  for (const Options::Settable& settable : options.settable) names.push_back(settable.name);
  for (const ConfigLine& line : lines) {
    const std::string place = absl::StrCat(path, ":", line.line, ": ", line.key);
    if (std::find(names.begin(), names.end(), line.key) == names.end()) {
      const std::string hint = base::did_you_mean(line.key, names);
      return absl::InvalidArgumentError(
          absl::StrCat(place, ": no such option", hint, hint.empty() ? "; " : " ", "isofieldd --help lists them all"));
    }
    const CLI::Option& option = *options.app.get_option("--" + line.key);
    absl::Status status = check_kind(option, line);
    if (status.ok()) {
      const std::string fault = fault_of(line.key, line.value);
      if (!fault.empty()) status = absl::InvalidArgumentError(fault);
    }
    if (!status.ok()) {
      return absl::InvalidArgumentError(absl::StrCat(place, " = ", line.written, ": ", status.message()));
    }
    append_setting(option, line.key, line.value, flags);
  }
  return flags;
}

// Returns the settings of the environment as arguments of the command line. An empty variable counts as not set.
// INVALID_ARGUMENT: a value is faulty, or the name of an unknown variable ISOFIELD_... is near that of an option. Other
// unknown variables are ignored, since they may belong to another program or to a cluster.
absl::StatusOr<std::vector<std::string>> flags_of_environment(const Options& options) {
  std::vector<std::string> variables, flags;
  for (const Options::Settable& settable : options.settable) variables.push_back(settable.variable);
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const absl::string_view text = *entry;
    const std::string variable(text.substr(0, text.find('=')));
    if (!absl::StartsWith(variable, kPrefix) || std::count(variables.begin(), variables.end(), variable)) continue;
    // Only the parts after the common prefix are compared; with it most names would be near.
    std::vector<std::string> tails;
    for (const std::string& known : variables) tails.push_back(known.substr(kPrefix.size()));
    const std::string tail = base::nearest_name(absl::string_view(variable).substr(kPrefix.size()), tails);
    if (tail.empty()) continue;
    return absl::InvalidArgumentError(
        absl::StrCat("the environment's ", variable, " belongs to no option; did you mean '", kPrefix, tail, "'?"));
  }
  for (const Options::Settable& settable : options.settable) {
    const char* const value = std::getenv(settable.variable.c_str());
    if (value == nullptr || *value == '\0') continue;
    const std::string fault = fault_of(settable.name, value);
    if (!fault.empty()) {
      return absl::InvalidArgumentError(
          absl::StrCat("the environment's ", settable.variable, " = ", value, ": ", fault));
    }
    append_setting(*settable.option, settable.name, value, flags);
  }
  return flags;
}

// Returns the text for an error of the command line. For an unknown option it suggests the nearest known one.
std::string explain(const Options& options, const CLI::ParseError& error) {
  const std::vector<std::string> extras = options.app.remaining();
  // Only a flag fails like this: a faulty number fails its check, and a text needs no conversion.
  if (dynamic_cast<const CLI::ConversionError*>(&error)) return absl::StrCat(error.what(), "; expected true or false");
  if (extras.empty()) return error.what();
  const std::string wanted = extras.front().substr(0, extras.front().find('='));
  std::vector<std::string> names{"--config", "--help", "--version"};
  for (const Options::Settable& settable : options.settable) names.push_back("--" + settable.name);
  return absl::StrCat(wanted, ": no such option", base::did_you_mean(wanted, names));
}

ParsedConfig refuse(absl::string_view message) {
  std::fprintf(stderr, "isofieldd: %s\nisofieldd --help lists the options.\n", std::string(message).c_str());
  return {std::nullopt, 2};
}

}  // namespace

ParsedConfig parse_config(int argc, char** argv, const std::string& version) {
  std::vector<std::string> flags(argv + std::min(argc, 1), argv + argc);
  // The command line is parsed by itself first: --help and --version come before everything else, and --config names
  // the file.
  Options stated(version);
  try {
    parse(stated, flags);
  } catch (const CLI::Success& success) {
    // CLI11 gets to know the variables only here, so that --help lists them.
    for (const Options::Settable& settable : stated.settable) settable.option->envname(settable.variable);
    return {std::nullopt, stated.app.exit(success)};
  } catch (const CLI::ParseError& error) {
    return refuse(explain(stated, error));
  }
  std::vector<std::string> all;
  if (!stated.config_path.empty()) {
    auto of_file = flags_of_file(stated, stated.config_path);
    if (!of_file.ok()) return refuse(of_file.status().message());
    all = *std::move(of_file);
  }
  const auto of_environment = flags_of_environment(stated);
  if (!of_environment.ok()) return refuse(of_environment.status().message());
  all.insert(all.end(), of_environment->begin(), of_environment->end());
  all.insert(all.end(), flags.begin(), flags.end());
  Options options(version);
  try {
    parse(options, all);
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  }
  Config c = options.c;
  c.queue.delay = std::chrono::microseconds(options.delay_us);
  c.limits.max_streams = c.max_threads * 3 / 4;
  c.limits.max_tracked_meshes = c.max_threads / 8;
  return {std::move(c), 0};
}

}  // namespace isofield::daemon
