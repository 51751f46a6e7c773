#include "importers/detect.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include "isofield/scene_file.h"
#include "test_support.h"

namespace isofield {
namespace {

constexpr char kAtom[] = "ATOM      1  N   THR A   1      17.047  14.099   3.625  1.00 13.79           N\n";
constexpr char kSwc[] = "1 1 0 0 0 6 -1\n2 3 0 8 0 1.2 1\n3 3 1 16 0 1 2\n";
constexpr char kXyz[] = "2\nwater\nO 0 0 0\nH 1 0 0\n";
constexpr char kTinker[] = "2 water\n1 O 0 0 0 1 2\n2 H 1 0 0 2 1\n";
constexpr char kMmcif[] = "# made by hand\ndata_X\nloop_\n_atom_site.id\n";
constexpr char kScene[] = "\xEF\xBB\xBF\n {\"nodes\": []}";

std::string message() {
  v1::Scene scene;
  scene.add_nodes()->mutable_sphere()->set_radius(1);
  return scene.SerializeAsString();
}

TEST(Detect, ContentOutweighsTheEnding) {
  for (const char* const name : {"a.txt", "a.dat", "a", "a.pdb", "a.swc", "a.xyz", "a.json", "a.csv", "a.pb"}) {
    EXPECT_EQ(*detect_kind(kSwc, name), FileKind::kSwc) << name;
    EXPECT_EQ(*detect_kind(kAtom, name), FileKind::kPdb) << name;
    EXPECT_EQ(*detect_kind(absl::StrCat("HEADER  x\n", kAtom), name), FileKind::kPdb) << name;
    EXPECT_EQ(*detect_kind(kMmcif, name), FileKind::kMmcif) << name;
    EXPECT_EQ(*detect_kind(kXyz, name), FileKind::kXyz) << name;
    EXPECT_EQ(*detect_kind(kTinker, name), FileKind::kXyz) << name;
    EXPECT_EQ(*detect_kind(kScene, name), FileKind::kSceneJson) << name;
    EXPECT_EQ(*detect_kind(message(), name), FileKind::kSceneMessage) << name;
  }
}

TEST(Detect, PointsAreWhatNothingElseClaims) {
  for (const char* const name : {"a.txt", "a.dat", "a", "a.xyz", "a.csv", "a.json"}) {
    for (const char* const text :
         {"0 0 0\n1 2 3\n", "# c\n0,0,0\n", "x;y;z\n1,5;2;3\n", "z y x r\n1 2 3 4\n", "x,y,z\n", "0.5 1 2 3 4 5 6\n",
          "2\n0 0 0\n1 1 1\n", "1 2 3 4 5 6 7\n8 9 10 11 12 13 14\n"}) {
      EXPECT_EQ(*detect_kind(text, name), FileKind::kPoints) << name << ": " << text;
    }
  }
}

TEST(Detect, TheEndingDecidesWhereContentDoesNot) {
  EXPECT_EQ(*detect_kind("0 0 0\n", "a.swc"), FileKind::kSwc);
  EXPECT_EQ(*detect_kind("rubbish\n", "a.PDB"), FileKind::kPdb);
  EXPECT_EQ(*detect_kind("rubbish\n", "a.cif"), FileKind::kMmcif);
  EXPECT_EQ(*detect_kind("rubbish\n", "a.xyz"), FileKind::kXyz);
  EXPECT_EQ(*detect_kind("rubbish\n", "a.txt"), FileKind::kPoints);
  EXPECT_EQ(*detect_kind("rubbish\n", "a.json"), FileKind::kSceneJson);
  EXPECT_EQ(*detect_kind("", "a.pb"), FileKind::kSceneMessage);
  for (const char* const name : {"a.pb.gz", "a.PB.GZ", "a.pb.Gz"}) {
    EXPECT_EQ(*detect_kind("", name), FileKind::kSceneMessage) << name;
  }
  EXPECT_EQ(*detect_kind("rubbish\n", "a.JSON.GZ"), FileKind::kSceneJson);
}

TEST(Detect, OddSwcFilesAreKnown) {
  EXPECT_EQ(*detect_kind("# c\r1,1,0,0,0,6,-1\r2,3,0,8,0,1.2,1\r", "a.txt"), FileKind::kSwc);
  EXPECT_EQ(*detect_kind("2 3 0 8 0 1.2 1\n1 1 0 0 0 6 -1\n", "a"), FileKind::kSwc) << "parents later";
  EXPECT_EQ(*detect_kind("1 1 0 0 0 6 1\n2 3 0 8 0 0 1 label\n", "a"), FileKind::kSwc)
      << "a root that is its own parent";
  EXPECT_EQ(*detect_kind("7 2 0 0 0 nan -1\nrubbish\n8 2 0 0 1 1 7\n9 2 0 0 2 1 8\n10 2 0 0 2 1 9\n", "a"),
            FileKind::kSwc);
}

TEST(Detect, WhatCannotBeReadIsNamedAndAnsweredWithWhatCan) {
  const std::string zeros(600, '\0');
  std::string stl(84 + 50, '\0');
  stl[80] = 1;
  const std::pair<std::string, std::string> files[] = {
      {"\x89PNG\r\n\x1a\n" + zeros, "a PNG picture"},
      {"PK\3\4" + zeros, "a ZIP archive"},
      {"\x89HDF\r\n\x1a\n" + zeros, "an HDF5 file"},
      {"glTF" + zeros, "a GLB mesh"},
      {"\x93NUMPY" + zeros, "a NumPy array"},
      {std::string(208, '\0') + "MAP " + zeros, "a CCP4 or MRC map"},
      {stl, "an STL mesh"},
      {"ply\nformat ascii 1.0\n", "a PLY mesh"},
      {"# by hand\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", "an OBJ mesh"},
      {"solid a\n facet normal 0 0 1\n", "an STL mesh"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "an OFF mesh"},
      {"title\n  by\n\n  1  0  0     0  0            999 V2000\n    0.0    0.0    0.0 C\n", "an SDF or MOL molecule"},
      {"<html>\n", "XML or a web page"},
      {"\xFF\xFEx\0", "text in UTF-16"},
      {"\x01\x02\x03" + zeros, "binary data of an unknown kind"},
      {"", "the file is empty"},
      {"some words\n", "its format cannot be recognised"},
  };
  for (const auto& [content, what] : files) {
    for (const char* const name : {"a.dat", "a"}) {
      const auto kind = detect_kind(content, name);
      ASSERT_EQ(kind.status().code(), absl::StatusCode::kInvalidArgument) << what;
      EXPECT_TRUE(absl::StartsWith(kind.status().message(), absl::StrCat(name, ": ", what))) << kind.status();
      EXPECT_TRUE(absl::StrContains(kind.status().message(), "expected a scene (.json, .pb), a neuron (.swc)"));
    }
  }
  EXPECT_FALSE(detect_kind("\x89PNG\r\n\x1a\n" + zeros, "a.swc").ok());
  EXPECT_FALSE(detect_kind("\x01\x02\x03" + zeros, "a.pb").ok());
  EXPECT_FALSE(detect_kind("\x01\x02\x03" + zeros, "a.txt").ok());
}

TEST(Detect, SharedFilesAreWhatTheyAre) {
  const std::string swc = shared_data("odd/swc_named.txt");
  ISOFIELD_SKIP_WITHOUT(swc);
  const auto imported = import_file(swc, {});
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.format, "neuron (SWC)");
  const std::pair<const char*, FileKind> files[] = {{"1A8O.pdb", FileKind::kPdb},
                                                    {"4hhb.pdb", FileKind::kPdb},
                                                    {"1A8O.cif", FileKind::kMmcif},
                                                    {"odd/small.cif", FileKind::kMmcif},
                                                    {"extended.xyz", FileKind::kXyz},
                                                    {"odd/properties_pos_last.xyz", FileKind::kXyz},
                                                    {"odd/isotopes.xyz", FileKind::kXyz},
                                                    {"segment_tracing_particles.txt", FileKind::kPoints},
                                                    {"hemibrain_1734350788.swc", FileKind::kSwc},
                                                    {"odd/ids_beyond_53_bits.swc", FileKind::kSwc},
                                                    {"odd/scale_header.swc", FileKind::kSwc},
                                                    {"odd/turned_box.json", FileKind::kSceneJson}};
  for (const auto& [file, kind] : files) {
    EXPECT_EQ(*detect_kind(*read_file(shared_data(file)), "no_ending"), kind) << file;
  }
}

}  // namespace
}  // namespace isofield
