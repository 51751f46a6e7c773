// Tests the daemon as an administrator sees it: addresses, options, signals, restarts.
#include <gtest/gtest.h>
#include <isofield/client.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "grpc/health/v1/health.grpc.pb.h"
#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {
namespace {

void expect_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
}

TEST(Lifecycle, ServesOnAFreePortOfTcp) {
  Daemon daemon({}, "127.0.0.1:0");
  EXPECT_EQ(daemon.address().substr(0, 10), "127.0.0.1:");
  EXPECT_GT(std::stoi(daemon.address().substr(10)), 0);
  expect_serving(daemon.address());
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client.ok());
  EXPECT_TRUE(client->info().ok());
}

TEST(Lifecycle, ASecondDaemonOnTheSamePortIsRefused) {
  Daemon daemon({}, "127.0.0.1:0");
  const Outcome second = run(daemon_command({"--listen", daemon.address()}));
  EXPECT_EQ(second.exit_code, 1);
  expect_in(second.errors, {"isofieldd: ", daemon.address(), "--listen"});
  expect_serving(daemon.address());
}

TEST(Lifecycle, ASecondDaemonOnTheSameSocketIsRefused) {
  Daemon daemon;
  const Outcome second = run(daemon_command({"--listen", daemon.address()}));
  EXPECT_EQ(second.exit_code, 1);
  expect_in(second.errors, {"isofieldd: ", "another process serves on " + daemon.address()});
  expect_serving(daemon.address());
}

TEST(Lifecycle, ASocketLeftByAKilledDaemonIsTakenOver) {
  const TemporaryDirectory directory;
  const std::string address = "unix:" + directory.path("s");
  {
    Daemon killed({}, address);
    killed.kill();
  }
  EXPECT_EQ(directory.listing(), "s\n");
  Daemon daemon({}, address);
  expect_serving(address);
}

TEST(Lifecycle, AddressesThatCannotBeServedAreRefused) {
  const TemporaryDirectory directory;
  write_file(directory.path("file"), "precious");
  for (const std::string& address :
       {std::string("unix:"), "unix:" + std::string(200, 'x'), "unix:" + directory.path("none/s"),
        "unix:" + directory.path("file"), std::string("127.0.0.1"), std::string("203.0.113.7:5000"),
        std::string("127.0.0.1:99999"), std::string("127.0.0.1:http"), std::string("127.0.0.1:-1"),
        std::string(":5000"), std::string("nonsense"), std::string("unix-abstract:name"), std::string("")}) {
    const Outcome outcome = run(daemon_command({"--listen", address}));
    EXPECT_EQ(outcome.exit_code, 1) << address;
    expect_in(outcome.errors, {"isofieldd: ", "--listen"});
  }
  EXPECT_EQ(read_file(directory.path("file")), "precious") << "only sockets are taken over";
}

TEST(Lifecycle, SigtermLetsARunningMeshFinish) {
  Daemon daemon({"--drain-seconds", "300"});
  Peer peer(daemon.address());
  LimitedContext context;
  const auto stream = peer.meshes().Mesh(&context, mesh_request(inlined(Ball().scene()), 0.004));
  v1::MeshResponse response;
  ASSERT_TRUE(stream->Read(&response));
  ASSERT_TRUE(response.has_progress());
  daemon.process().signal(SIGTERM);
  ASSERT_NE(daemon.process().wait_for_error_line("finishing running requests"), "");
  std::uint64_t vertices = 0, received = 0;
  do {
    if (response.has_summary()) vertices = response.summary().vertices();
    if (response.has_part()) received += response.part().positions().data().size() / 12;
  } while (stream->Read(&response));
  EXPECT_TRUE(ok(stream->Finish()));
  EXPECT_GT(vertices, 100'000u);
  EXPECT_EQ(received, vertices);
  daemon.expect_orderly_end();
}

// Programs that watch the server's health learn at once that it is stopping, while running requests finish.
TEST(Lifecycle, HealthIsNotServingDuringTheDrain) {
  Daemon daemon({"--drain-seconds", "300"});
  Peer peer(daemon.address());
  const auto health = grpc::health::v1::Health::NewStub(peer.channel());
  LimitedContext watching;
  const auto watch = health->Watch(&watching, {});
  grpc::health::v1::HealthCheckResponse state;
  ASSERT_TRUE(watch->Read(&state));
  EXPECT_EQ(state.status(), grpc::health::v1::HealthCheckResponse::SERVING);
  daemon.process().signal(SIGTERM);
  ASSERT_TRUE(watch->Read(&state));
  EXPECT_EQ(state.status(), grpc::health::v1::HealthCheckResponse::NOT_SERVING);
  watching.TryCancel();
  watch->Finish();
  daemon.expect_orderly_end();
}

TEST(Lifecycle, SigtermEndsIdleStreamsAfterTheDrain) {
  Daemon daemon({"--drain-seconds", "1"});
  Peer peer(daemon.address());
  LimitedContext context;
  const auto stream = peer.fields().EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  *request.mutable_points() = points_tensor(std::span<const float>(points_around(Ball(), 1, 10)));
  ASSERT_TRUE(stream->Write(request));
  v1::EvaluateResponse response;
  ASSERT_TRUE(stream->Read(&response));
  daemon.stop();
  EXPECT_FALSE(stream->Finish().ok());
}

TEST(Lifecycle, ASecondSignalEndsItAtOnce) {
  Daemon daemon({"--drain-seconds", "3600"});
  Peer peer(daemon.address());
  LimitedContext context;
  const auto stream = peer.fields().EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  *request.mutable_points() = points_tensor(std::span<const float>(points_around(Ball(), 1, 10)));
  ASSERT_TRUE(stream->Write(request));
  v1::EvaluateResponse response;
  ASSERT_TRUE(stream->Read(&response));
  daemon.process().signal(SIGTERM);
  ASSERT_NE(daemon.process().wait_for_error_line("finishing running requests"), "");
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait(), 128 + SIGTERM);
  daemon.kill();
}

TEST(Lifecycle, SigintStopsItToo) {
  Daemon daemon;
  daemon.process().signal(SIGINT);
  daemon.expect_orderly_end();
}

TEST(Lifecycle, HelpListsEveryOptionWithItsDefault) {
  const Outcome outcome = run(daemon_command({"--help"}));
  EXPECT_EQ(outcome.exit_code, 0);
  // The test has a table of its own, so that no option comes, goes or changes its default unnoticed.
  const std::map<std::string, std::string> expected{{"--help", ""},
                                                    {"--listen", "127.0.0.1:50051"},
                                                    {"--data-dir", ""},
                                                    {"--device", ""},
                                                    {"--validation", ""},
                                                    {"--log-level", "info"},
                                                    {"--drain-seconds", "10"},
                                                    {"--max-threads", "256"},
                                                    {"--compile-ahead", ""},
                                                    {"--max-kernels", "512"},
                                                    {"--max-nodes", "1000000"},
                                                    {"--max-primitives", "1000000"},
                                                    {"--max-scenes", "1000"},
                                                    {"--max-message-bytes", "67108864"},
                                                    {"--max-points-per-message", "1048576"},
                                                    {"--max-grid-points", "4294967296"},
                                                    {"--max-mesh-cells", "33554432"},
                                                    {"--max-queued-requests", "1024"},
                                                    {"--max-queued-points", "8388608"},
                                                    {"--max-running-requests", "1024"},
                                                    {"--max-running-points", "68719476736"},
                                                    {"--queue-delay-us", "0"},
                                                    {"--hot-points", "1048576"},
                                                    {"--max-operators", "10000"},
                                                    {"--shared-memory", ""},
                                                    {"--max-shared-regions", "64"},
                                                    {"--max-shared-bytes", "1073741824"},
                                                    {"--config", ""},
                                                    {"--version", ""}};
  // The text of an option begins with a line such as "  --max-nodes UINT:within [1, 5]=3 (Env:ISOFIELD_MAX_NODES)".
  const std::regex option_line("\n  (?:-[a-z],)?(--[a-z-]+)(?:[ \n](?:[A-Z]+(?::[^=\n]*)?)?(?:=([^ \n]+))?)");
  std::map<std::string, std::string> listed;
  for (std::sregex_iterator at(outcome.output.begin(), outcome.output.end(), option_line), end; at != end; ++at) {
    EXPECT_TRUE(listed.emplace((*at)[1], (*at)[2]).second) << (*at)[1] << " is listed twice";
  }
  EXPECT_EQ(listed, expected) << outcome.output;
  EXPECT_EQ(run(daemon_command({"--version"})).output.substr(0, 10), "isofieldd ");
}

TEST(Lifecycle, WrongUsageIsTold) {
  for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{{"--nonsense"},
                                                                                     {"--listen"},
                                                                                     {"surplus"},
                                                                                     {"--log-level", "loud"},
                                                                                     {"--drain-seconds", "-1"},
                                                                                     {"--max-nodes", "many"},
                                                                                     {"--max-mesh-cells", "0"},
                                                                                     {"--config", "/none.toml"}}) {
    const Outcome outcome = run(daemon_command(flags));
    EXPECT_EQ(outcome.exit_code, 2) << flags[0];
    // A file that is missing is named by its path.
    expect_in(outcome.errors, {flags[0] == "--config" ? flags[1] : flags[0]});
  }
}

// The daemon refuses these flags with exit code 2 before anything is started, and its text names the place.
void expect_wrong(const std::vector<std::string>& flags, const std::vector<std::string>& parts) {
  const Outcome outcome = run(daemon_command(flags));
  EXPECT_EQ(outcome.exit_code, 2) << parts[0];
  expect_in(outcome.errors, parts);
  EXPECT_EQ(outcome.errors.find("listening"), std::string::npos) << outcome.errors;
}

TEST(Lifecycle, FlagsAreRefusedWithWhatIsAccepted) {
  expect_wrong({"--max-nodes", "-1"}, {"--max-nodes: expected a whole number within [1, 2147483648], not -1"});
  expect_wrong({"--max-nodes", "1e6"}, {"--max-nodes: expected a whole number within", "not 1e6"});
  expect_wrong({"--max-nodes", "18446744073709551616"}, {"--max-nodes: expected a whole number within"});
  expect_wrong({"--max-threads", "3"}, {"--max-threads: expected a whole number within [4, 65536], not 3"});
  expect_wrong({"--max-shared-bytes", "0"}, {"--max-shared-bytes: expected a whole number within [1, "});
  expect_wrong({"--hot-points", "-5"}, {"--hot-points: expected a whole number within [0, "});
  expect_wrong({"--max-node", "5"}, {"--max-node: no such option; did you mean '--max-nodes'?"});
  expect_wrong({"--validation=perhaps"}, {"--validation = perhaps; expected true or false"});
}

TEST(Lifecycle, AConfigurationFileIsRefusedByLineAndKey) {
  const TemporaryDirectory directory;
  const std::string path = directory.path("isofieldd.toml");
  const struct {
    std::string text;
    std::vector<std::string> parts;
  } kBad[] = {
      {"max-node = 5\n", {":1: max-node: no such option; did you mean 'max-nodes'?"}},
      {"# comment\n\nmax-scenes = 5\ncolour = \"red\"\n", {":4: colour: no such option", "--help lists"}},
      {"config = \"x\"\n", {":1: config: no such option"}},
      {"max-nodes = -1\n", {":1: max-nodes = -1: expected a whole number within [1, 2147483648]"}},
      {"max-nodes = 0\n", {":1: max-nodes = 0: expected a whole number within [1, 2147483648]"}},
      {"max-nodes = \"5\"\n", {":1: max-nodes = \"5\": expected a whole number, without quotes"}},
      {"max-nodes = 5.5\n", {":1: max-nodes = 5.5: expected a whole number"}},
      {"max-nodes = true\n", {":1: max-nodes = true: expected a whole number"}},
      {"max-nodes = many\n", {":1: max-nodes = many: expected a text in quotes, a number, true or false"}},
      {"max-nodes = 99999999999999999999999\n",
       {":1: max-nodes = 99999999999999999999999: expected a whole number within"}},
      {"validation = 1\n", {":1: validation = 1: expected true or false"}},
      {"validation = \"true\"\n", {":1: validation = \"true\": expected true or false"}},
      {"device = 5\n", {":1: device = 5: expected a text in quotes"}},
      {"log-level = \"loud\"\n", {":1: log-level = \"loud\"", "debug"}},
      {"max-nodes = 5\nmax-scenes = 5\nmax-nodes = 6\n", {":3: max-nodes is set twice in this file: line 1 sets it"}},
      {"max-nodes\n", {":1: max-nodes: expected KEY = VALUE"}},
      {"max-nodes =\n", {":1: max-nodes = : expected a text in quotes"}},
      {"= 5\n", {":1: = 5: expected KEY = VALUE"}},
      {"max-nodes = 5 6\n", {":1: max-nodes = 5 6: expected a text in quotes, a number"}},
      {"device = \"a\" b\n", {":1: b: expected the end of the line"}},
      {"device = \"a\n", {":1: device = \"a"}},
      {"[limits]\nmax-nodes = 5\n", {":1: [limits]: this file has no tables"}},
      {"max-nodes: 5\n", {":1: max-nodes: 5: expected KEY = VALUE"}},
      {"{\"max-nodes\": 5}\n", {":1: {", "expected KEY = VALUE"}},
  };
  for (const auto& [text, parts] : kBad) {
    write_file(path, text);
    std::vector<std::string> all = parts;
    all[0] = path + all[0];
    expect_wrong({"--config", path}, all);
  }
  expect_wrong({"--config", directory.path("none.toml")}, {directory.path("none.toml")});
  expect_wrong({"--config", directory.path("")}, {directory.path(""), "directory"});
  write_file(path, "max-nodes = 5\n");
  expect_wrong({"--config", path, "--max-nodes", "x"}, {"--max-nodes: expected a whole number"});
}

TEST(Lifecycle, TheEnvironmentIsRefusedByItsVariables) {
  const auto with = [](const char* variable, const char* value, const std::vector<std::string>& parts) {
    ::setenv(variable, value, 1);
    expect_wrong({}, parts);
    ::unsetenv(variable);
  };
  with("ISOFIELD_MAX_NODES", "-1", {"ISOFIELD_MAX_NODES = -1: expected a whole number within [1, 2147483648]"});
  with("ISOFIELD_VALIDATION", "perhaps", {"ISOFIELD_VALIDATION = perhaps: expected true or false"});
  with("ISOFIELD_LOG_LEVEL", "loud", {"ISOFIELD_LOG_LEVEL = loud", "debug"});
  with("ISOFIELD_MAX_NODE", "5", {"ISOFIELD_MAX_NODE belongs to no option; did you mean 'ISOFIELD_MAX_NODES'?"});
}

TEST(Lifecycle, DevicesAndFoldersThatCannotBeUsedAreRefused) {
  const TemporaryDirectory directory;
  write_file(directory.path("file"), "");
  Outcome outcome = run(daemon_command({"--listen", "unix:" + directory.path("s"), "--device", "no such device"}));
  EXPECT_EQ(outcome.exit_code, 1);
  expect_in(outcome.errors, {"no such device"});
  outcome = run(daemon_command({"--listen", "unix:" + directory.path("s"), "--data-dir", directory.path("file/x")}));
  EXPECT_EQ(outcome.exit_code, 1);
  expect_in(outcome.errors, {"--data-dir", directory.path("file/x")});
}

TEST(Lifecycle, FlagsOverrideTheEnvironmentAndThatTheFile) {
  const TemporaryDirectory directory;
  write_file(directory.path("isofieldd.toml"),
             "\xef\xbb\xbf# limits\r\n\"max-nodes\" = 1_001 # of a scene\r\nmax-scenes=11\nmax-grid-points = 0x1389\n"
             "data-dir = '" +
                 directory.path("d#1") + "'\ndevice = \"\"\nshared-memory = false\n\n");
  ::setenv("ISOFIELD_MAX_SCENES", "12", 1);
  ::setenv("ISOFIELD_MAX_GRID_POINTS", "5002", 1);
  Daemon daemon({"--config", directory.path("isofieldd.toml"), "--max-grid-points", "5003"});
  ::unsetenv("ISOFIELD_MAX_SCENES");
  ::unsetenv("ISOFIELD_MAX_GRID_POINTS");
  Peer peer(daemon.address());
  const v1::Limits limits = peer.info().limits();
  EXPECT_EQ(limits.max_nodes(), 1001u);
  EXPECT_EQ(limits.max_scenes(), 12u);
  EXPECT_EQ(limits.max_grid_points(), 5003u);
  EXPECT_TRUE(std::filesystem::is_directory(directory.path("d#1"))) << "a # in quotes begins no comment";
}

TEST(Lifecycle, CompiledShadersOutliveTheProcess) {
  const TemporaryDirectory directory;
  const std::string folder = directory.path("data/of/isofield/shader-cache");
  // A folder that the environment states would take the place of the daemon's own.
  const char* const stated = std::getenv("MESA_SHADER_CACHE_DIR");
  const std::string kept = stated ? stated : "";
  ::unsetenv("MESA_SHADER_CACHE_DIR");
  std::string driver;
  // Returns the files that the cache holds after a process has served some points.
  const auto files_after_a_process = [&] {
    {
      Daemon daemon({"--data-dir", directory.path("data/of/isofield"), "--hot-points", "0"});
      expect_serving(daemon.address());
      driver = Peer(daemon.address()).info().device().driver();
    }
    std::set<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.file_size() > 0) paths.insert(entry.path().string());
    }
    return paths;
  };
  const std::set<std::string> first = files_after_a_process(), second = files_after_a_process();
  if (stated) ::setenv("MESA_SHADER_CACHE_DIR", kept.c_str(), 1);
  if (driver.find("Mesa") == std::string::npos) GTEST_SKIP() << "only Mesa keeps its shaders there, not " << driver;
  EXPECT_GT(first.size(), 1u) << "the cache has an index and at least one shader";
  EXPECT_EQ(second, first) << "the second process has compiled shaders again";
}

}  // namespace
}  // namespace isofield::integration_test
