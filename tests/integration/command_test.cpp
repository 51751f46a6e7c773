// Tests the command line against the real daemon: from files to files, exit codes, and no half-written files.
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_split.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/glb_reader.h"
#include "integration/peer.h"
#include "integration/process.h"
#include "integration/temporary_directory.h"
#include "support/eventually.h"
#include "support/mesh_check.h"

namespace isofield::integration_test {
namespace {

constexpr char kBall[] =
    R"({"nodes": [{"name": "ball", "sphere": {"center": [0.25, -0.5, 0.125], "radius": 1, "range": 0.5}}]})";

class Command : public testing::Test {
 protected:
  void SetUp() override { write_file(path("ball.json"), kBall); }
  void TearDown() override {
    for (const v1::SceneSummary& summary : peer_.list()) EXPECT_TRUE(ok(peer_.remove(summary.name())));
    expect_serving(shared_daemon().address());
  }

  std::string path(const std::string& name) const { return directory_.path(name); }
  std::vector<std::string> command(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{ISOFIELD_COMMAND, "--server", shared_daemon().address()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  Outcome isofield(const std::vector<std::string>& arguments, const std::string& input = "/dev/null") const {
    return run(command(arguments), input);
  }
  void expect_exit(int code, const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const {
    const Outcome outcome = isofield(arguments);
    EXPECT_EQ(outcome.exit_code, code) << arguments[0] << ": " << outcome.errors;
    for (const std::string& part : parts) {
      EXPECT_NE(outcome.errors.find(part), std::string::npos) << "'" << part << "' in: " << outcome.errors;
    }
  }
  // The output file appears in the directory when the process begins to write.
  void wait_until_it_writes(Process& process, const std::string& listing_before) const {
    const auto has_come = [&] { return directory_.listing() != listing_before || !process.is_running(); };
    EXPECT_TRUE(test_support::eventually(has_come)) << process.errors();
  }

  TemporaryDirectory directory_;
  Ball ball_;
  Peer peer_{shared_daemon().address()};
};

TEST_F(Command, KeepsScenesOnTheServer) {
  Outcome outcome = isofield({"put", path("ball.json"), "--name", "a/ball"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  outcome = isofield({"ls"});
  EXPECT_NE(outcome.output.find("a/ball"), std::string::npos) << outcome.output;
  outcome = isofield({"show", "a/ball"});
  EXPECT_EQ(outcome.exit_code, 0);
  write_file(path("again.json"), outcome.output);
  EXPECT_EQ(isofield({"put", path("again.json"), "--name", "again"}).exit_code, 0) << "what is shown can be put";
  v1::GetSceneResponse shown, stored;
  ASSERT_TRUE(ok(peer_.get("again", &shown)));
  ASSERT_TRUE(ok(peer_.get("a/ball", &stored)));
  EXPECT_EQ(shown.scene().SerializeAsString(), stored.scene().SerializeAsString());
  EXPECT_EQ(isofield({"edit", "again", "ball.radius=2"}).exit_code, 0);
  EXPECT_EQ(isofield({"rm", "a/ball"}).exit_code, 0);
  expect_exit(1, {"rm", "a/ball"}, {"a/ball", "again"});
  outcome = isofield({"info"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("resident 1 scenes"), std::string::npos) << outcome.output;
  outcome = isofield({"info", "--device"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("slab_bricks"), std::string::npos) << outcome.output;
}

TEST_F(Command, EvaluatesAFileOfPoints) {
  const std::vector<float> xyz = points_around(ball_, 1, 100'000);
  std::string csv = "x,y,z\n";
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    absl::StrAppendFormat(&csv, "%.9g,%.9g,%.9g\n", xyz[i], xyz[i + 1], xyz[i + 2]);
  write_file(path("points.csv"), csv);
  const Outcome outcome =
      isofield({"eval", path("ball.json"), "--points", path("points.csv"), "--gradient", "-o", path("out.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  std::ifstream in(path("out.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "x,y,z,value,gx,gy,gz");
  std::vector<float> results;
  for (std::size_t i = 0; std::getline(in, line); i += 3) {
    const std::vector<std::string> cells = absl::StrSplit(line, ',');
    ASSERT_EQ(cells.size(), 7u);
    for (int c = 0; c < 7; ++c) {
      float number = 0;
      ASSERT_TRUE(absl::SimpleAtof(cells[c], &number));
      if (c >= 3)
        results.push_back(number);
      else
        ASSERT_EQ(number, xyz[i + c]);
    }
  }
  ASSERT_EQ(results.size(), xyz.size() / 3 * 4);
  const Ball::Errors errors = ball_.errors(xyz, results);
  EXPECT_LE(errors.value, 2e-5);
  EXPECT_LE(errors.gradient, 1e-3);
}

TEST_F(Command, EvaluatesBetweenPipes) {
  write_file(path("in"), "0.25 -0.5 1.125\n");
  const Outcome outcome = isofield({"eval", path("ball.json"), "--points", "-"}, path("in"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.substr(0, 12), "x,y,z,value\n");
  EXPECT_NEAR(std::stod(outcome.output.substr(outcome.output.rfind(',') + 1)), 0.5, 1e-5);
}

TEST_F(Command, MeshesIntoEveryFormat) {
  for (const char* name : {"m.glb", "m.obj", "m.ply", "m.stl"}) {
    const Outcome outcome = isofield({"mesh", path("ball.json"), "--cell", "0.1", "-o", path(name)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_GT(read_file(path(name)).size(), 10'000u);
  }
  const GlbMesh mesh = read_glb(path("m.glb"));
  EXPECT_TRUE(test_support::check_mesh(mesh.positions, mesh.triangles).sound());
  EXPECT_EQ(isofield({"render", path("ball.json"), "-o", path("m.png")}).exit_code, 0);
  EXPECT_EQ(read_file(path("m.png")).substr(1, 3), "PNG");
}

TEST_F(Command, MeshesAnEmptySurfaceIntoAFileThatViewersOpen) {
  const Outcome outcome =
      isofield({"mesh", path("ball.json"), "--cell", "0.1", "--bounds", "50,50,50,51,51,51", "-o", path("empty.glb")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("empty"), std::string::npos);
  EXPECT_TRUE(read_glb(path("empty.glb")).triangles.empty());
}

TEST_F(Command, ExitCodesAndTextsTellWhatIsWrong) {
  write_file(path("bad.json"), R"({"nodes": [{"name": "ball", "sphere": {"radius": -1, "range": 1}}]})");
  write_file(path("nan.csv"), "0,0,0\n1,nan,1\n");
  write_file(path("points.csv"), "0,0,0\n");
  write_file(path("empty"), "");
  expect_exit(1, {"put", path("bad.json")}, {"ball", "radius = -1", "> 0"});
  expect_exit(1, {"eval", "nothing", "--points", path("points.csv")}, {"nothing"});
  expect_exit(4, {"eval", path("ball.json"), "--points", path("nan.csv")}, {"nan.csv:2", "finite"});
  expect_exit(4, {"eval", path("ball.json"), "--points", path("none.csv")}, {"none.csv"});
  expect_exit(4, {"put", path("none.json")}, {"none.json"});
  expect_exit(4, {"put", path("empty")}, {path("empty")});
  expect_exit(4, {"put", directory_.path("")}, {directory_.path("")});
  expect_exit(4, {"mesh", path("ball.json"), "--cell", "0.1", "-o", path("none/m.glb")}, {"none/m.glb"});
  expect_exit(1, {"mesh", path("ball.json"), "--cell", "1e-9", "-o", path("m.glb")},
              {"cell_size", "smallest cell size"});
  expect_exit(1, {"mesh", path("ball.json"), "--iso", "2", "-o", path("m.glb")}, {"iso = 2"});
  expect_exit(2, {"mesh", path("ball.json"), "--cell", "0", "-o", path("m.glb")}, {"--cell"});
  expect_exit(2, {"mesh", path("ball.json"), "-o", path("m.xyz")}, {".glb"});
  expect_exit(2, {"mesh"}, {"SCENE"});
  expect_exit(2, {"nonsense"}, {});
  const Outcome down = run({ISOFIELD_COMMAND, "--server", "unix:" + path("down"), "ls"});
  EXPECT_EQ(down.exit_code, 3);
  EXPECT_NE(down.errors.find("start isofieldd there or state another --server"), std::string::npos) << down.errors;
  EXPECT_EQ(directory_.listing().find("m.glb"), std::string::npos) << "refused requests write no file";
}

TEST_F(Command, KilledWhileItWritesItLeavesTheOldFile) {
  write_file(path("m.stl"), "old");
  const std::string before = directory_.listing();
  int killed = 0;
  for (int round = 0; round < 10 && killed < 3; ++round) {
    Process process(command({"mesh", path("ball.json"), "--cell", "0.005", "-o", path("m.stl")}));
    wait_until_it_writes(process, before);
    process.signal(SIGKILL);
    const int code = process.wait();
    const std::string written = read_file(path("m.stl"));
    if (code == 0) {
      EXPECT_GT(written.size(), 1'000'000u) << "it was quicker than the signal: all is there";
    } else {
      EXPECT_EQ(code, 128 + SIGKILL) << process.errors();
      EXPECT_TRUE(written == "old") << written.size() << " bytes under the final name";
      ++killed;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
      const std::string name = entry.path().filename();
      if (name.rfind("m.stl.", 0) == 0) std::filesystem::remove(entry.path());
    }
    write_file(path("m.stl"), "old");
  }
  EXPECT_EQ(killed, 3) << "it was quicker than the signal";
}

TEST_F(Command, InterruptedItRemovesWhatItBegan) {
  const std::string before = "ball.json\n";
  bool is_interrupted = false;
  for (int round = 0; round < 10 && !is_interrupted; ++round) {
    Process process(command({"mesh", path("ball.json"), "--cell", "0.005", "-o", path("m.stl")}));
    wait_until_it_writes(process, before);
    process.signal(SIGTERM);
    is_interrupted = process.wait() != 0;
    if (is_interrupted) {
      EXPECT_EQ(process.wait(), 128 + SIGTERM) << process.errors();
      EXPECT_EQ(directory_.listing(), before);
    }
    std::filesystem::remove(path("m.stl"));
  }
  EXPECT_TRUE(is_interrupted) << "it was quicker than the signal";
}

TEST_F(Command, ARefusedCellIsRefusedInTheWordsOfItsOption) {
  const std::string ball = path("ball.json");
  for (const char* const name : {"mesh", "render", "measure"}) {
    const std::string command = name;
    std::vector<std::string> arguments{command, ball};
    if (command != "measure") arguments.insert(arguments.end(), {"-o", path(command == "mesh" ? "a.glb" : "a.png")});
    const auto with = [&](const std::string& option, const std::string& value) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {option, value});
      return all;
    };
    expect_exit(1, with("--cell", "1e-30"),
                {"cell_size = 1e-30 takes more than the ", "smallest cell size", "(--cell)"});
    expect_exit(1, with("--resolution", "1048576"),
                {"resolution = 1048576 takes more than the ", "largest resolution", "(--resolution)"});
    expect_exit(0, with("--cell", "1000"),
                {"warning: cells of 1000 are too coarse for 1 primitive: ball, the thinnest, "
                 "is 2 across",
                 "may be torn or lack parts; try --cell 1.15"});
  }
  write_file(path("origins.csv"), "0,0,3\n");
  expect_exit(1, {"ray", ball, "--origins", path("origins.csv"), "--direction", "0,0,-1", "--cell", "1e-30"},
              {"cell_size = 1e-30 takes more than the ", "(--cell)"});
}

TEST_F(Command, KeepsTheLargestBodyAndFillsVoids) {
  write_file(path("two.json"), R"({"unit": "mm", "nodes": [
    {"name": "outer", "sphere": {"radius": 1, "range": 0.2}}, {"name": "hole", "sphere": {"radius": 0.7, "range": 0.2}},
    {"name": "hollow", "difference": {"children": ["outer", "hole"]}},
    {"name": "beside", "sphere": {"center": [3, 0, 0], "radius": 0.5, "range": 0.2}},
    {"max": {"children": ["hollow", "beside"]}}]})");
  const auto mesh = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"mesh", path("two.json"), "--cell", "0.1", "-o", path("two.glb")};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = isofield(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.output;
  };
  EXPECT_NE(mesh({}).find("two.glb: 2 bodies, 1 void, "), std::string::npos);
  EXPECT_NE(mesh({"--largest"}).find("two.glb: 1 body, 1 void (1 body left out), "), std::string::npos);
  EXPECT_NE(mesh({"--fill-voids"}).find("two.glb: 2 bodies (1 void left out), "), std::string::npos);
  EXPECT_NE(mesh({"--largest", "--fill-voids"}).find("two.glb: 1 body (1 body, 1 void left out), "), std::string::npos);
}

}  // namespace
}  // namespace isofield::integration_test
