// Options of the daemon from a file, the environment and the command line.
#include "daemon/config.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "support/temporary_folder.h"

namespace isofield::daemon {
namespace {

// Sets an environment variable until the end of its block.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* const name_;
};

struct Outcome {
  ParsedConfig parsed;
  std::string output, errors;
};

Outcome parse(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "isofieldd");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome{parse_config(static_cast<int>(argv.size()), argv.data(), "1.2.3"), "", ""};
  outcome.output = testing::internal::GetCapturedStdout();
  outcome.errors = testing::internal::GetCapturedStderr();
  return outcome;
}

Config parsed(const std::vector<std::string>& arguments) {
  const Outcome outcome = parse(arguments);
  EXPECT_TRUE(outcome.parsed.config.has_value()) << outcome.errors;
  return outcome.parsed.config.value_or(Config());
}

void expect_refused(const std::vector<std::string>& arguments, const std::string& text) {
  const Outcome outcome = parse(arguments);
  EXPECT_FALSE(outcome.parsed.config.has_value()) << text;
  EXPECT_EQ(outcome.parsed.exit_status, 2);
  EXPECT_TRUE(absl::StrContains(outcome.errors, text)) << "'" << text << "' in: " << outcome.errors;
}

class ConfigTest : public testing::Test {
 protected:
  // Returns the file's path.
  std::string write(const std::string& text) const {
    const std::string path = absl::StrCat(folder_.path(), "/isofieldd.toml");
    std::ofstream(path) << text;
    return path;
  }

  const test_support::TemporaryFolder folder_;
};

TEST_F(ConfigTest, WithoutOptionsItIsTheDefaults) {
  const Config c = parsed({}), defaults;
  EXPECT_EQ(c.listen, defaults.listen);
  EXPECT_EQ(c.log_level, defaults.log_level);
  EXPECT_EQ(c.drain_seconds, defaults.drain_seconds);
  EXPECT_EQ(c.compile_ahead, defaults.compile_ahead);
  EXPECT_EQ(c.hot_points, defaults.hot_points);
  EXPECT_EQ(c.max_kernels, defaults.max_kernels);
  EXPECT_EQ(c.queue.delay, std::chrono::microseconds(0));
  EXPECT_EQ(c.limits.scene.max_nodes, defaults.limits.scene.max_nodes);
  EXPECT_EQ(c.limits.batches.max_points, defaults.limits.batches.max_points);
  EXPECT_EQ(c.limits.requests.max_points, defaults.limits.requests.max_points);
  // These two follow from the number of threads.
  EXPECT_EQ(c.limits.max_streams, defaults.limits.max_streams);
  EXPECT_EQ(c.limits.max_tracked_meshes, defaults.limits.max_tracked_meshes);
}

TEST_F(ConfigTest, FlagsOverrideTheEnvironmentWhichOverridesTheFile) {
  const std::string path = write(
      "max-nodes = 11\nmax-scenes = 11\nmax-operators = 11\nlisten = \"unix:file\"\ndevice = \"file\"\n"
      "log-level = \"debug\"\nvalidation = true\nshared-memory = true\ncompile-ahead = false\n");
  const Variable scenes("ISOFIELD_MAX_SCENES", "12"), operators("ISOFIELD_MAX_OPERATORS", "12"),
      device("ISOFIELD_DEVICE", "environment"), level("ISOFIELD_LOG_LEVEL", "trace"),
      memory("ISOFIELD_SHARED_MEMORY", "false"), ahead("ISOFIELD_COMPILE_AHEAD", "false"),
      nodes("ISOFIELD_MAX_NODES", "");
  // Options count from wherever they stand: --config comes last.
  const Config c =
      parsed({"--max-operators", "13", "--log-level=warn", "--compile-ahead", "--config", path, "--max-operators=14"});
  EXPECT_EQ(c.limits.scene.max_nodes, 11u) << "an empty variable counts as none";
  EXPECT_EQ(c.limits.max_scenes, 12u);
  EXPECT_EQ(c.limits.max_operators, 14u) << "the last of two counts";
  EXPECT_EQ(c.listen, "unix:file");
  EXPECT_EQ(c.device, "environment");
  EXPECT_EQ(c.log_level, "warn");
  EXPECT_TRUE(c.validation);
  EXPECT_FALSE(c.shared_memory);
  EXPECT_TRUE(c.compile_ahead);
}

TEST_F(ConfigTest, OptionsReachTheLimitsThatTheyAreNamedAfter) {
  const Config c = parsed({"--max-threads", "40", "--queue-delay-us", "250", "--max-queued-requests", "3",
                           "--max-queued-points", "4", "--max-running-requests", "5", "--max-running-points", "6",
                           "--max-shared-regions", "7", "--max-shared-bytes", "8", "--max-primitives", "9"});
  EXPECT_EQ(c.limits.max_streams, 30);
  EXPECT_EQ(c.limits.max_tracked_meshes, 5);
  EXPECT_EQ(c.queue.delay, std::chrono::microseconds(250));
  EXPECT_EQ(c.limits.batches.max_requests, 3u);
  EXPECT_EQ(c.limits.batches.max_points, 4u);
  EXPECT_EQ(c.limits.requests.max_requests, 5u);
  EXPECT_EQ(c.limits.requests.max_points, 6u);
  EXPECT_EQ(c.limits.shared.max_regions, 7u);
  EXPECT_EQ(c.limits.shared.max_bytes, 8u);
  EXPECT_EQ(c.limits.scene.max_primitives, 9u);
}

TEST_F(ConfigTest, ARefusalNamesTheKeyAndWhatIsAccepted) {
  const std::string accepted = "expected a whole number within [1, 2147483648], not 0";
  expect_refused({"--max-nodes", "0"}, "--max-nodes: " + accepted);
  expect_refused({"--max-node", "5"}, "--max-node: no such option; did you mean '--max-nodes'?");
  expect_refused({"--validation=perhaps"}, "expected true or false");
  {
    const Variable nodes("ISOFIELD_MAX_NODES", "0");
    expect_refused({}, "the environment's ISOFIELD_MAX_NODES = 0: " + accepted);
  }
  {
    const Variable near("ISOFIELD_MAX_NODE", "5");
    expect_refused({}, "ISOFIELD_MAX_NODE belongs to no option; did you mean 'ISOFIELD_MAX_NODES'?");
  }
  std::string path = write("max-scenes = 5\nmax-nodes = 0\n");
  expect_refused({"--config", path}, absl::StrCat(path, ":2: max-nodes = 0: ", accepted));
  path = write("max-nodes = \"5\"\n");
  expect_refused({"--config", path}, ":1: max-nodes = \"5\": expected a whole number, without quotes");
}

TEST_F(ConfigTest, AFaultIsRefusedWhereAStrongerSourceOverridesIt) {
  const std::string path = write("max-nodes = 0\n");
  expect_refused({"--config", path, "--max-nodes", "5"}, absl::StrCat(path, ":1: max-nodes = 0"));
  const Variable nodes("ISOFIELD_MAX_NODES", "many");
  expect_refused({"--max-nodes", "5"}, "ISOFIELD_MAX_NODES = many");
}

TEST_F(ConfigTest, HelpAndVersionComeBeforeEverythingElse) {
  const Variable nodes("ISOFIELD_MAX_NODES", "many");
  const Outcome version = parse({"--config", folder_.path() + "/none.toml", "--version"});
  EXPECT_FALSE(version.parsed.config.has_value());
  EXPECT_EQ(version.parsed.exit_status, 0);
  EXPECT_EQ(version.output, "isofieldd 1.2.3\n");
  const Outcome help = parse({"--help"});
  EXPECT_FALSE(help.parsed.config.has_value());
  EXPECT_EQ(help.parsed.exit_status, 0);
  for (const char* text : {"--max-nodes", "ISOFIELD_MAX_NODES", "--queue-delay-us", "ISOFIELD_QUEUE_DELAY_US"}) {
    EXPECT_TRUE(absl::StrContains(help.output, text)) << text;
  }
}

}  // namespace
}  // namespace isofield::daemon
