#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "command_fixture.h"
#include "isofield/scene_file.h"

namespace isofield {
namespace {

constexpr char kBall[] = R"({"nodes": [{"name": "ball", "sphere": {"radius": 1, "range": 1}}]})";

using CliTest = CommandFixture;

TEST_F(CliTest, KeepsScenes) {
  write_file(path("my ball.json"), kBall);
  EXPECT_EQ(run("put '" + path("my ball.json") + "'"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "my_ball: version 1, 1 nodes")) << out_;
  EXPECT_EQ(run("put --name other '" + path("my ball.json") + "' --json"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "\"name\":\"other\"")) << out_;
  EXPECT_EQ(run("ls"), 0);
  EXPECT_TRUE(absl::StrContains(out_, "my_ball")) << out_;
  EXPECT_EQ(run("show other"), 0);
  EXPECT_TRUE(parse_scene_json(out_, "out").ok()) << out_;
  EXPECT_EQ(run("edit other ball.center=1,-2,3"), 0) << err_;
  EXPECT_EQ(run("edit other ball.center"), 2);
  EXPECT_EQ(run("edit other ball.center=a"), 2);
  EXPECT_EQ(run("edit other nothing.center=1"), 1);
  EXPECT_EQ(run("rm other"), 0);
  EXPECT_EQ(out_, "other: deleted\n");
  EXPECT_EQ(run("rm other"), 1);
  EXPECT_TRUE(absl::StrContains(err_, "no scene \"other\"")) << err_;
  EXPECT_EQ(run("--json info"), 0);
  EXPECT_TRUE(absl::StrContains(out_, "\"version\":\"0.0.0-fake\"")) << out_;
}

TEST_F(CliTest, ImportsWithoutAServer) {
  write_file(path("a.swc"), "1 3 0 0 0 1 -1\n2 3 5 0 0 1 1\nrubbish\n3 3 5 5 0 1 2\n");
  address_ = "127.0.0.1:1";
  EXPECT_EQ(run("import " + path("a.swc") + " -o " + path("a.json") + " --operator sum --json"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(err_, "line 3: rubbish")) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "\"pieces\":2")) << out_;
  EXPECT_EQ(read_scene_file(path("a.json"))->nodes(2).sum().children_size(), 2);
  EXPECT_EQ(run("import " + path("a.swc") + " --operator nonsense"), 2);
  EXPECT_EQ(run("import " + path("none.swc")), 4);
}

TEST_F(CliTest, EvaluatesPoints) {
  write_file(path("ball.json"), kBall);
  EXPECT_EQ(run("eval " + path("ball.json") + " --points - --gradient", "x,y,z\n1,2,3\n0,0,0.5\n"), 0) << err_;
  EXPECT_EQ(out_, "x,y,z,value,gx,gy,gz\n1,2,3,14,1,2,3\n0,0,0.5,1.5,1,2,3\n");
  EXPECT_EQ(run("eval " + path("ball.json") + " --points - -o " + path("r.npy"), "1 2 3\n"), 0) << err_;
  EXPECT_EQ(read_file(path("r.npy"))->size(), 132u);
  EXPECT_EQ(run("eval " + path("ball.json") + " --points - -o " + path("bad.csv"), "1 2 3\n1 2 x\n"), 4);
  EXPECT_TRUE(absl::StrContains(err_, "<stdin>:2:")) << err_;
  EXPECT_FALSE(read_file(path("bad.csv")).ok());
  EXPECT_EQ(run("eval none --points -", "1 2 3\n"), 1);
  EXPECT_EQ(run("eval none.json --points -", "1 2 3\n"), 4);
}

TEST_F(CliTest, MeshesAndRenders) {
  write_file(path("ball.json"), kBall);
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    EXPECT_EQ(run("mesh " + path("ball.json") + " --cell 0.1 -o " + path(name)), 0) << err_;
    EXPECT_GT(read_file(path(name))->size(), 1000u);
  }
  EXPECT_EQ(run("--json mesh " + path("ball.json") + " --resolution 64 --bounds -1,-1,-1,1,1,1 -o " + path("b.glb")), 0)
      << err_;
  EXPECT_TRUE(absl::StrContains(out_, "\"request_seconds\"")) << out_;
  EXPECT_EQ(run("render " + path("ball.json") + " --size 64x48 --view top -o " + path("a.png")), 0) << err_;
  EXPECT_EQ(read_file(path("a.png"))->substr(1, 3), "PNG");
  EXPECT_EQ(run("mesh " + path("ball.json") + " -o " + path("a.xyz")), 2);
  for (const char* cell : {"0", "-1", "nan", "inf", "x"}) {
    EXPECT_EQ(run("mesh " + path("ball.json") + " --cell " + cell + " -o " + path("a.glb")), 2) << cell;
    EXPECT_LT(err_.size(), 160u) << err_;
  }
  EXPECT_EQ(run("mesh " + path("ball.json") + " --cell 1 --resolution 4 -o " + path("a.glb")), 2);
  const int reads = server_.reads;
  EXPECT_EQ(run("mesh " + path("ball.json") + " -o /no/such/directory/a.glb"), 4);
  EXPECT_EQ(run("render " + path("ball.json") + " -o /no/such/directory/a.png"), 4);
  EXPECT_EQ(run("eval " + path("ball.json") + " --points - -o /no/such/directory/a.csv", "1 2 3\n"), 4);
  EXPECT_EQ(server_.reads, reads) << "before anything is asked for";
  EXPECT_EQ(run("mesh " + path("ball.json") + " --iso 2 -o " + path("a.glb")), 1);
  EXPECT_TRUE(absl::StrContains(err_, "stated bounds (--bounds)")) << err_;
  EXPECT_EQ(run("render " + path("ball.json") + " --size 64 -o " + path("a.png")), 2);
  EXPECT_EQ(run("mesh none -o " + path("none.glb")), 1);
}

TEST_F(CliTest, WarnsOfCellsThatAreTooCoarse) {
  write_file(path("ball.json"), kBall);
  EXPECT_EQ(run("mesh " + path("ball.json") + " -o " + path("a.glb")), 0);
  EXPECT_TRUE(absl::StrContains(out_, "a.glb: 1 body, 2048 vertices")) << out_;
  EXPECT_EQ(err_, "");
  EXPECT_EQ(run("mesh " + path("ball.json") + " --largest -o " + path("a.glb")), 0);
  EXPECT_TRUE(absl::StrContains(out_, "a.glb: 1 body (2 bodies left out), ")) << out_;
  server_.too_thin = true;
  for (const std::string& command : {"mesh " + path("ball.json") + " -o " + path("a.glb"),
                                     "render " + path("ball.json") + " --size 64x48 -o " + path("a.png")}) {
    EXPECT_EQ(run(command), 0);
    EXPECT_TRUE(absl::StrContains(out_, ": 3 bodies, ")) << out_;
    EXPECT_TRUE(absl::StrContains(err_,
                                  "warning: cells of 12.5 are too coarse for 1 primitive: n7, the thinnest, is 20 "
                                  "across and takes cells of at most 11.5; the mesh has 3 bodies and may be torn "
                                  "or lack parts; the server admits no smaller ones"))
        << err_;
    EXPECT_EQ(run(command + " --cell 12.5"), 0);
    EXPECT_TRUE(absl::StrContains(err_, "; --cell 11.5 would do\n")) << err_;
    EXPECT_EQ(run(command + " --resolution 50"), 0);
    EXPECT_TRUE(absl::StrContains(err_, "higher --resolution")) << err_;
    EXPECT_EQ(run("--json " + command), 0);
    EXPECT_EQ(err_, "");
    EXPECT_TRUE(absl::StrContains(out_, "\"warnings\":[\"cells of 12.5 are too coarse")) << out_;
    EXPECT_TRUE(absl::StrContains(out_, "\"too_thin\":{")) << out_;
  }
}

TEST_F(CliTest, MeshFilesAreInTheUnitThatIsAskedFor) {
  write_file(path("ball.json"), kBall);
  const auto mesh = [&](const std::string& options) { return run("--json mesh " + path("ball.json") + " " + options); };
  const auto scale = [&](const std::string& text) {
    return absl::StrContains(out_, "\"scale\":" + text + ",") || absl::StrContains(out_, "\"scale\":" + text + "}");
  };
  EXPECT_EQ(mesh("-o " + path("a.glb")), 0);
  EXPECT_TRUE(scale("1")) << out_;
  EXPECT_EQ(mesh("--units mm -o " + path("a.stl")), 2);
  EXPECT_TRUE(absl::StrContains(err_, "the scene's unit is \"\"")) << err_;
  EXPECT_EQ(mesh("--units furlong -o " + path("a.stl")), 2);
  EXPECT_TRUE(absl::StrContains(err_, "--units furlong: expected m, ")) << err_;
  EXPECT_EQ(mesh("--units mm --scale 2 -o " + path("a.stl")), 2);
  EXPECT_EQ(mesh("--scale 0 -o " + path("a.stl")), 2);
  EXPECT_EQ(mesh("--scale 1e30 -o " + path("a.stl")), 2);
  server_.mesh_unit = "um";
  EXPECT_EQ(mesh("-o " + path("a.glb")), 0);
  EXPECT_TRUE(scale("1e-06") || scale("1e-6")) << out_;
  EXPECT_EQ(mesh("-o " + path("a.ply")), 0);
  EXPECT_TRUE(scale("1")) << out_;
  EXPECT_TRUE(absl::StrContains(*read_file(path("a.ply")), "\ncomment unit um\n"));
  EXPECT_EQ(mesh("--units nm -o " + path("a.ply")), 0);
  EXPECT_TRUE(scale("1000")) << out_;
  EXPECT_TRUE(absl::StrContains(*read_file(path("a.ply")), "\ncomment unit nm\n"));
  EXPECT_EQ(mesh("--scale 2 -o " + path("a.ply")), 0);
  EXPECT_TRUE(absl::StrContains(*read_file(path("a.ply")), "\ncomment unit um, coordinates times 2\n"));
  server_.mesh_unit = "voxel";
  EXPECT_EQ(mesh("-o " + path("a.glb")), 0);
  EXPECT_TRUE(scale("1") && absl::StrContains(out_, "the scene's unit is \\\"voxel\\\"")) << out_;
}

TEST_F(CliTest, ExitCodesTellServersFilesAndUsageApart) {
  write_file(path("bad.json"), "{\"nodes\": [{]}");
  EXPECT_EQ(run("put " + path("bad.json")), 4);
  EXPECT_TRUE(absl::StrContains(err_, "bad.json:1:")) << err_;
  write_file(path("empty.json"), "{}");
  EXPECT_EQ(run("put " + path("empty.json")), 1);
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("nonsense"), 2);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_EQ(run("mesh --help"), 0);
  EXPECT_EQ(run("--version"), 0);
  address_ = "nonsense";
  EXPECT_EQ(run("ls"), 2);
  address_ = "unix:" + path("nothing");
  EXPECT_EQ(run("ls"), 3);
  EXPECT_TRUE(absl::StrContains(err_, "isofieldd --listen unix:")) << err_;
}

TEST_F(CliTest, AnInterruptedMeshLeavesNoFileAndStopsTheServer) {
  write_file(path("ball.json"), kBall);
  server_.endless_mesh = true;
  const std::string command = "timeout -s INT 0.5 " + std::string(ISOFIELD_COMMAND) + " --server " + address_ +
                              " mesh " + path("ball.json") + " -o " + path("m.glb");
  EXPECT_NE(std::system(command.c_str()), 0);
  for (int i = 0; i < 200 && !server_.mesh_cancelled; ++i) ::usleep(10000);
  EXPECT_TRUE(server_.mesh_cancelled);
  EXPECT_FALSE(read_file(path("m.glb")).ok());
}

}  // namespace
}  // namespace isofield
