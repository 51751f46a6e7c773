// Runs `isofield watch` as a process against a server inside the test.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "fake_server.h"
#include "integration/process.h"
#include "isofield/scene_file.h"
#include "support/eventually.h"
#include "test_support.h"

namespace isofield {
namespace {

using integration_test::Process;

constexpr char kBall[] = R"({"nodes": [{"name": "ball", "sphere": {"radius": 1, "range": 1}}]})";

class WatchTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.path(name); }
  std::vector<std::string> command(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{ISOFIELD_COMMAND, "--server", address_,      "--json", "watch",
                                 path(scene),      "-o",       path("a.png"), "--size", "32x24"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  // Sets a mark that tells the next picture from this one.
  void mark(const std::string& unit) { server_.mesh_unit = unit; }
  static std::string marked(const std::string& unit) { return "\"unit\":\"" + unit + "\""; }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) names.insert(entry.path().filename());
    return names;
  }

  TemporaryDirectory directory_;
  std::string address_ = "unix:" + path("socket");
  FakeServer server_{address_};
};

TEST_F(WatchTest, DrawsAgainWhenTheFileChanges) {
  write_file(path("ball.json"), kBall);
  mark("first");
  Process process(command("ball.json"));
  ASSERT_NE(process.wait_for_output_line(marked("first")), "") << process.errors();
  EXPECT_TRUE(read_file(path("a.png")).ok());

  mark("written");
  write_file(path("ball.json"), kBall);
  ASSERT_NE(process.wait_for_output_line(marked("written")), "");

  mark("renamed");
  write_file(path("ball.json~"), kBall);
  std::filesystem::rename(path("ball.json~"), path("ball.json"));
  ASSERT_NE(process.wait_for_output_line(marked("renamed")), "");

  const std::string before = *read_file(path("a.png"));
  write_file(path("ball.json"), R"({"nodes": [{"spere": {}}]})");
  ASSERT_NE(process.wait_for_error_line("ball.json:1:13: "), "");
  ASSERT_NE(process.wait_for_output_line("\"exit_code\":4"), "");
  EXPECT_EQ(*read_file(path("a.png")), before) << "the picture stays";

  mark("mended");
  write_file(path("ball.json"), kBall);
  ASSERT_NE(process.wait_for_output_line(marked("mended")), "");
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(files(), (std::set<std::string>{"a.png", "ball.json", "socket"}));
}

TEST_F(WatchTest, WatchesImportedFilesWithAView) {
  write_file(path("cell.swc"), "1 1 0 0 0 1 -1\n2 3 5 0 0 1 1\n");
  mark("first");
  Process process(command("cell.swc", {"--view-file", path("view.json"), "--view", "top"}));
  ASSERT_NE(process.wait_for_output_line(marked("first")), "") << process.errors();
  mark("second");
  write_file(path("cell.swc"), "1 1 0 0 0 1 -1\n2 3 9 0 0 1 1\n");
  ASSERT_NE(process.wait_for_output_line(marked("second")), "");
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(files(), (std::set<std::string>{"a.png", "cell.swc", "socket", "view.json"}));
}

TEST_F(WatchTest, EndsWhileItWaitsForTheServer) {
  write_file(path("ball.json"), kBall);
  server_.endless_mesh = true;
  Process process(command("ball.json"));
  EXPECT_TRUE(test_support::eventually([&] { return server_.reads > 0 || !process.is_running(); }));
  EXPECT_GT(server_.reads, 0) << process.errors();
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(files(), (std::set<std::string>{"ball.json", "socket"}));
  server_.endless_mesh = false;
}

TEST_F(WatchTest, RefusesWhatItCannotWatch) {
  EXPECT_EQ(integration_test::run(command("none.json")).exit_code, 4);
  EXPECT_EQ(integration_test::run(command("")).exit_code, 4) << "a folder";
  write_file(path("ball.json"), kBall);
  EXPECT_EQ(integration_test::run(command("ball.json", {"--size", "9"})).exit_code, 2);
  address_ = "unix:" + path("nothing");
  EXPECT_EQ(integration_test::run(command("ball.json")).exit_code, 3) << "a server that never was there";
}

}  // namespace
}  // namespace isofield
