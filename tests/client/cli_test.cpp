#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_split.h>
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
  EXPECT_TRUE(absl::StartsWith(out_, "NAME                                VERSION      NODES   PRIMITIVES")) << out_;
  EXPECT_TRUE(absl::StrContains(out_, "\nmy_ball                                   1          1")) << out_;
  EXPECT_EQ(run("ls --json"), 0);
  EXPECT_TRUE(absl::StartsWith(out_, R"({"scenes":[{"name":"my_ball",)")) << out_;
  EXPECT_TRUE(absl::EndsWith(out_, "}],\"has_more\":false}\n")) << out_;
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

TEST_F(CliTest, TellsTheNumbersThatFitTheDevice) {
  EXPECT_EQ(run("info --device"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(out_, "device   Fake GPU")) << out_;
  EXPECT_TRUE(absl::StrContains(out_, "16384  bricks of a mesh in one submission (bricks)")) << out_;
  EXPECT_EQ(run("info --device --json"), 0) << err_;
  EXPECT_TRUE(absl::StartsWith(out_, "{\"name\":\"Fake GPU\"")) << out_;
  EXPECT_TRUE(absl::StrContains(out_, "{\"name\":\"slab_bricks\",\"value\":16384,\"unit\":\"bricks\"")) << out_;
  EXPECT_EQ(run("info"), 0) << err_;
  EXPECT_FALSE(absl::StrContains(out_, "slab_bricks")) << out_;
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

TEST_F(CliTest, RaysThatAreFedBackMeanTheirHits) {
  write_file(path("ball.json"), kBall);
  const std::string ball = path("ball.json");
  // The last ray runs along the plane.
  const std::string origins = "id,z,y,x\n7,1,0,0\n8,2,0,0.25\n9,3,1,0\n10,4,0,0\n";
  write_file(path("origins.csv"), origins);
  write_file(path("directions.csv"), "dx,dy,dz\n0,0,-1\n0,0,-2\n0,-1,-1\n2,-1,0\n");
  const std::string rays = " --origins " + path("origins.csv") + " --directions " + path("directions.csv");
  const auto expect_hits = [&](const std::string& csv) {
    std::size_t rows = 0;
    for (const absl::string_view row : absl::StrSplit(csv, '\n', absl::SkipEmpty())) {
      const std::vector<absl::string_view> cells = absl::StrSplit(row, ',');
      float value = 0;
      if (absl::SimpleAtof(cells.back(), &value)) {
        EXPECT_NEAR(value, 0.5, 1e-5) << "the iso value: " << row;
        ++rows;
      }
    }
    EXPECT_EQ(rows, 3u) << csv;
  };
  ASSERT_EQ(run("ray " + ball + rays), 0) << err_;
  ASSERT_EQ(run("eval " + ball + " --points -", std::string(out_)), 0) << err_;
  EXPECT_TRUE(absl::StrContains(err_, "note: <stdin>: 1 row is left out")) << err_;
  expect_hits(out_);
  ASSERT_EQ(run("ray " + ball + rays + " -o " + path("hits.npy")), 0) << err_;
  ASSERT_EQ(run("eval " + ball + " --points - ", *read_file(path("hits.npy"))), 0) << err_;
  expect_hits(out_);
  ASSERT_EQ(run("--json eval " + ball + " --points " + path("hits.npy") + " -o " + path("v.csv")), 0) << err_;
  EXPECT_EQ(err_, "");
  EXPECT_TRUE(absl::StrContains(out_, "\"points\":3") && absl::StrContains(out_, "hits.npy: 1 row is left out"))
      << out_;
  expect_hits(*read_file(path("v.csv")));
  // These values have no columns of points, so they are refused instead of read from other columns.
  EXPECT_EQ(run("eval " + ball + " --points -", "u,v,value\n0,0,0.5\n"), 4);
  EXPECT_TRUE(absl::StrContains(err_, "<stdin>:1: the columns are u, v, value; expected x, y and z")) << err_;
  EXPECT_EQ(run("ray " + ball + " --origins - --directions -", "1 2 3\n"), 2);
}

TEST_F(CliTest, ColumnsWithoutNamesAreMentioned) {
  write_file(path("ball.json"), kBall);
  EXPECT_EQ(run("eval " + path("ball.json") + " --points -", "1 2 3 9 9\n0 0 0.5 9 9\n"), 0);
  EXPECT_EQ(out_, "x,y,z,value\n1,2,3,14\n0,0,0.5,1.5\n");
  EXPECT_EQ(err_,
            "note: <stdin>: the columns have no names: the first three of 5 are read as x, y, z, and the others are "
            "ignored\n");
}

TEST_F(CliTest, OutputsOfAnotherKindAreRefusedBeforeWork) {
  write_file(path("ball.json"), kBall);
  write_file(path("a.swc"), "1 3 0 0 0 1 -1\n2 3 5 0 0 1 1\n");
  const std::string ball = path("ball.json"), points = " --points -";
  const std::pair<std::string, const char*> commands[] = {
      {"import " + path("a.swc") + " -o " + path("a.glb"), "`isofield mesh` writes meshes"},
      {"import " + path("a.swc") + " -o " + path("a.PNG"), "`isofield render`"},
      {"import " + path("a.swc") + " -o " + path("a.csv"), "`operator eval`"},
      {"import " + path("a.swc") + " -o " + path("a.xlsx"), "no command writes such files"},
      {"eval " + ball + points + " -o " + path("a.glb"), "expected .csv or .npy"},
      {"eval " + ball + points + " -o " + path("a.json"), "expected .csv or .npy"},
      {"project " + ball + points + " -o " + path("a.png"), "expected .csv or .npy or .json"},
      {"slice " + ball + " --origin 0,0,0 --spacing 1 --counts 2,2 -o " + path("a.stl"), "`isofield mesh`"},
      {"operator eval max" + points + " -o " + path("a.npy"), "expected .csv. `isofield eval`"},
  };
  for (const auto& [command, part] : commands) {
    EXPECT_EQ(run(command, "1 2 3\n"), 2) << command;
    EXPECT_TRUE(absl::StrContains(err_, part)) << err_;
  }
  EXPECT_EQ(server_.reads, 0);
  EXPECT_EQ(run("import " + path("a.swc") + " -o " + path("scene")), 0) << err_;
}

TEST_F(CliTest, ScenesAreKnownByTheirContent) {
  v1::Scene scene = *parse_scene_json(kBall, "ball");
  write_file(path("message.dat"), scene.SerializeAsString());
  write_file(path("text.swc"), kBall);
  write_file(path("neuron"), "1 3 0 0 0 1 -1\n2 3 5 0 0 1 1\n");
  write_file(path("points"), "z;y;x\n0,5;0;0\n");
  for (const char* const file : {"message.dat", "text.swc", "neuron", "points"}) {
    EXPECT_EQ(run("eval " + path(file) + " --points -", "1 2 3\n"), 0) << file << ": " << err_;
    EXPECT_EQ(run("put " + path(file) + " --name a"), 0) << file << ": " << err_;
  }
  EXPECT_TRUE(absl::StrContains(err_, "points (XYZ): 1 read, 1 pieces made")) << err_;
  write_file(path("picture.swc"), std::string("\x89PNG\r\n\x1a\n\0\0", 10));
  EXPECT_EQ(run("import " + path("picture.swc")), 4);
  EXPECT_TRUE(absl::StrContains(err_, "picture.swc: a PNG picture; expected a scene (.json, .pb)")) << err_;
  EXPECT_EQ(out_, "");
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
                                  "across and needs cells of at most 11.5; the mesh has 3 bodies and may be torn "
                                  "or lack parts; the server allows no smaller cells"))
        << err_;
    EXPECT_EQ(run(command + " --cell 12.5"), 0);
    EXPECT_TRUE(absl::StrContains(err_, "; try --cell 11.5\n")) << err_;
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
  for (const char* const name : {"none.json", "none.PB", "none.JSON.GZ", "none.SWC.GZ"}) {
    EXPECT_EQ(run("eval " + path(name) + " --points -", "0 0 0\n"), 4) << name << ": " << err_;
  }
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
  EXPECT_EQ(err_, "isofield: nothing listens at " + address_ + "; start isofieldd there or state another --server\n");
}

TEST_F(CliTest, UsageErrorsNameTheNearestAndWhatIsAccepted) {
  write_file(path("ball.json"), kBall);
  const std::string ball = path("ball.json") + " ";
  const struct {
    std::string arguments, part;
  } kWrong[] = {
      {"rendr " + ball, "\"rendr\": no such command of isofield; did you mean \"render\"?; expected put, ls, "},
      {"operator sho sum", "\"sho\": no such command of isofield operator; did you mean \"show\"?"},
      {"", "a command is missing; expected put, ls, "},
      {"operator", "a command is missing; expected ls, show, "},
      {"render " + ball + "--azimut 3 -o a.png",
       "--azimut: no such option of isofield render; did you mean \"--azimuth\"?"},
      {"render --azimut=3 " + ball, "did you mean \"--azimuth\"?"},
      {"--sever x ls", "did you mean \"--server\"?"},
      {"ls surplus", "\"surplus\": isofield ls takes no further argument"},
      {"render -o a.png", "SCENE is required; SCENE is: A file, or else a name on the server"},
      {"mesh " + ball, "--output is required"},
      {"mesh " + ball + "-o a.glb --cell", "--cell"},
      {"mesh " + ball + "-o a.glb --resolution 0", "expected a whole number within [1, 1048576], not 0"},
      {"mesh " + ball + "-o a.glb --resolution 5x", "expected a whole number within [1, 1048576], not 5x"},
      {"mesh " + ball + "-o a.glb --bounds 1,2,3", "x0,y0,z0,x1,y1,z1: the box to mesh"},
      {"mesh " + ball + "-o a.glb --bounds 1,2,3,4,5,x", "expected a finite number, not x"},
      {"mesh " + ball + "-o a.glb --iso nan", "expected a finite number, not nan"},
      {"mesh " + ball + "-o a.glb --tolerance 1", "expected a number within [1e-05, 0.1], not 1"},
      {"render " + ball + "-o a.png --elevation 91", "expected a number within [-90, 90], not 91"},
      {"render " + ball + "-o a.png --view side", "back"},
      {"render " + ball + "-o a.png --up 1,2", "x,y,z: what is upwards"},
      {"render " + ball + "-o a.png --view front --up 0,0,1", "not parallel"},
      {"slice " + ball + "-o a.png --counts 0,5", "expected a whole number within [1, 4294967296], not 0"},
      {"slice " + ball + "-o a.png --spacing -1", "expected a finite number above 0, not -1"},
      {"edit a b.c=1 --expect-version -1", "expected a whole number at least 0, not -1"},
      {"operator pick " + ball + "top 1 2 x", "expected a finite number, not x"},
      {"--timeout nan ls", "expected a finite number above 0, not nan"},
  };
  for (const auto& [arguments, part] : kWrong) {
    EXPECT_EQ(run(arguments), 2) << arguments;
    EXPECT_TRUE(absl::StrContains(err_, part)) << "'" << part << "' in: " << err_;
    EXPECT_TRUE(absl::StrContains(err_, " --help says more.\n")) << err_;
    EXPECT_EQ(out_, "");
  }
}

TEST_F(CliTest, JsonHasNumbersInOneOrderAndErrors) {
  write_file(path("ball.json"), kBall);
  EXPECT_EQ(run("put --json --name a " + path("ball.json")), 0);
  EXPECT_EQ(out_,
            "{\"name\":\"a\",\"version\":1,\"nodes\":1,\"primitives\":0,\"device_bytes\":0,\"support_min\":[],"
            "\"support_max\":[]}\n");
  EXPECT_EQ(run("--json rm none"), 1);
  EXPECT_EQ(out_, "{\"error\":{\"code\":\"NOT_FOUND\",\"message\":\"no scene \\\"none\\\"\",\"exit_code\":1}}\n");
  EXPECT_EQ(run("nonsense --json"), 2);
  EXPECT_TRUE(absl::StartsWith(out_, "{\"error\":{\"code\":\"INVALID_ARGUMENT\",\"message\":")) << out_;
  EXPECT_TRUE(absl::EndsWith(out_, "\"exit_code\":2}}\n")) << out_;
  EXPECT_EQ(run("--json put /none.json"), 4);
  EXPECT_TRUE(absl::EndsWith(out_, "\"exit_code\":4}}\n")) << out_;
  EXPECT_EQ(run("import " + path("ball.json") + " -o " + path("ball.pb") + " --json"), 0);
  EXPECT_EQ(out_, "{\"file\":\"" + path("ball.pb") + "\"}\n");
  address_ = "unix:" + path("nothing");
  EXPECT_EQ(run("ls --json"), 3);
  EXPECT_TRUE(absl::StartsWith(out_, "{\"error\":{\"code\":\"UNAVAILABLE\",\"message\":\"nothing listens at ")) << out_;
}

TEST_F(CliTest, AViewFileKeepsTheCamera) {
  write_file(path("ball.json"), kBall);
  const std::string command = "render " + path("ball.json") + " --size 64x48 --view-file " + path("view.json") + " -o ";
  EXPECT_EQ(run(command + path("a.png") + " --azimuth 90 --elevation 0"), 0) << err_;
  const std::string kept = *read_file(path("view.json"));
  EXPECT_TRUE(absl::StrContains(kept, "\"direction\":[-1,")) << kept;
  EXPECT_EQ(run(command + path("b.png")), 0) << err_;
  EXPECT_EQ(*read_file(path("a.png")), *read_file(path("b.png"))) << "without flags the same";
  EXPECT_EQ(*read_file(path("view.json")), kept);
  EXPECT_EQ(run(command + path("c.png") + " --distance 100 --field-of-view 10"), 0) << err_;
  EXPECT_TRUE(absl::StrContains(*read_file(path("view.json")), "\"distance\":100,")) << "flags are saved";
  EXPECT_NE(*read_file(path("a.png")), *read_file(path("c.png")));
  write_file(path("view.json"), "{\"target\": [0, 0, 0]}");
  EXPECT_EQ(run(command + path("d.png")), 4);
  EXPECT_TRUE(absl::StrContains(err_, "view.json: distance is missing")) << err_;
  EXPECT_EQ(*read_file(path("view.json")), "{\"target\": [0, 0, 0]}") << "it is left alone";
  EXPECT_FALSE(read_file(path("d.png")).ok());
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
