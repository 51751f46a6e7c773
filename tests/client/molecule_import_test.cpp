#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include "isofield/import.h"
#include "test_support.h"

namespace isofield {
namespace {

absl::StatusOr<Imported> import_as(ImportFormat format, const std::string& text, const ImportOptions& options = {}) {
  return import_text(text, format, options, "test");
}

TEST(PdbImport, ElementFromColumnsOrName) {
  const auto imported = import_as(ImportFormat::kPdb,
                                  "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00  0.00           N  \r\n"
                                  "ATOM      2  CA  ALA A   1      11.639   6.071  -5.147  1.00  0.00\r\n"
                                  "HETATM    3 CA    CA A   2       1.639   6.071  -5.147  1.00  0.00\r\n"
                                  "ATOM      4 HG11 VAL A   3       2.639   6.071  -5.147\r\n"
                                  "HETATM    5 FE   HEM A   4       3.639   6.071  -5.147  1.00  0.00          FE\r\n"
                                  "HETATM    6  ??  UNK A   5       4.639   6.071  -5.147\r\n");
  ASSERT_TRUE(imported.ok()) << imported.status();
  const std::vector<double> radii = {1.55, 1.70, 2.31, 1.20, 2.0, 2.0};
  ASSERT_EQ(imported->report.pieces, radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_EQ(imported->scene.nodes(static_cast<int>(i)).sphere().radius(), radii[i]) << i;
  }
  EXPECT_EQ(imported->scene.nodes(1).name(), "A/ALA1/CA");
  EXPECT_EQ(imported->scene.nodes(0).sphere().center(2), -6.504);
  EXPECT_EQ(imported->scene.unit(), "angstrom");
  EXPECT_EQ(imported->report.findings.size(), 1u);
  EXPECT_EQ(imported->report.findings[0].count, 2u);
}

TEST(PdbImport, LeavesOutWaterOtherModelsAndAlternates) {
  const std::string text =
      "MODEL        1\n"
      "ATOM      1  CA AALA A   1      11.639   6.071  -5.147  1.00  0.00           C\n"
      "ATOM      2  CA BALA A   1      11.939   6.071  -5.147  1.00  0.00           C\n"
      "HETATM    3  O   HOH A   2       1.639   6.071  -5.147  1.00  0.00           O\n"
      "ATOM      4  CB  ALA A   1       xx      6.071  -5.147  1.00  0.00           C\n"
      "ATOM      5\n"
      "ENDMDL\n"
      "MODEL        2\n"
      "ATOM      1  CA  ALA A   1      11.639   6.071  -5.147  1.00  0.00           C\n"
      "ENDMDL\n";
  auto imported = import_as(ImportFormat::kPdb, text);
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.read, 6u);
  EXPECT_EQ(imported->report.pieces, 1u);
  EXPECT_TRUE(absl::StrContains(imported->report.text(), "2 x atom dropped")) << imported->report.text();
  EXPECT_TRUE(absl::StrContains(imported->report.text(), "1 x atom left out: water"));
  ImportOptions options;
  options.keep_waters = true;
  EXPECT_EQ(import_as(ImportFormat::kPdb, text, options)->report.pieces, 2u);
}

TEST(PdbImport, OnlyWaterOrNoAtomsIsAnError) {
  EXPECT_FALSE(import_as(ImportFormat::kPdb, "HEADER x\nEND\n").ok());
  const auto water =
      import_as(ImportFormat::kPdb, "HETATM    3  O   HOH A   2       1.639   6.071  -5.147  1.00  0.00           O\n");
  EXPECT_FALSE(water.ok());
  EXPECT_TRUE(absl::StrContains(water.status().message(), "water")) << water.status();
}

TEST(XyzImport, Molecule) {
  const auto imported =
      import_as(ImportFormat::kXyz, "4\r\nwater and more\r\nO 0 0 0\r\nH 0.9 0 0 0.1\r\nH1 -0.2 0.9 0\r\n6 5 5 5\r\n");
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.pieces, 4u);
  EXPECT_EQ(imported->scene.nodes(0).sphere().radius(), 1.52);
  EXPECT_EQ(imported->scene.nodes(0).sphere().range(), 0.76);
  EXPECT_EQ(imported->scene.nodes(2).sphere().radius(), 1.20);
  EXPECT_EQ(imported->scene.nodes(3).sphere().radius(), 1.70);
  EXPECT_FALSE(imported->report.damaged()) << imported->report.text();
}

TEST(XyzImport, DamagedMolecules) {
  const auto early = import_as(ImportFormat::kXyz, "5\n\nC 0 0 0\nC 1 x 0\nXx 1 1 1\n");
  ASSERT_TRUE(early.ok()) << early.status();
  EXPECT_EQ(early->report.pieces, 2u);
  EXPECT_EQ(early->report.findings.size(), 3u) << early->report.text();
  const auto more = import_as(ImportFormat::kXyz, "1\n\nC 0 0 0\nC 1 0 0\n");
  EXPECT_EQ(more->report.pieces, 1u);
  EXPECT_TRUE(more->report.damaged());
  const auto frames = import_as(ImportFormat::kXyz, "1\n\nC 0 0 0\n1\n\nC 1 0 0\n");
  EXPECT_EQ(frames->report.pieces, 1u);
  EXPECT_FALSE(frames->report.damaged());
  EXPECT_FALSE(import_as(ImportFormat::kXyz, "0\nempty\n").ok());
  EXPECT_FALSE(import_as(ImportFormat::kXyz, "99999999999999\n").ok());
}

TEST(XyzImport, BarePointsAreSoftObjects) {
  ImportOptions options;
  auto imported = import_as(ImportFormat::kPoints, "# points\n0 0 0\n\n1, 2, 3\nnan 0 0\n1 2\n", options);
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.pieces, 2u);
  EXPECT_EQ(imported->report.findings[0].count, 2u);
  EXPECT_NEAR(imported->scene.nodes(0).sphere().radius(), 0.454202 * 0.5, 1e-6);
  EXPECT_NEAR(imported->scene.nodes(0).sphere().range(), 0.545798 * 0.5, 1e-6);
  options.radius = 2;
  imported = import_as(ImportFormat::kXyz, "0 0 0\n", options);
  EXPECT_NEAR(imported->scene.nodes(0).sphere().radius(), 0.454202 * 2, 1e-5);
}

TEST(PdbImport, HivCapsid) {
  const std::string path = shared_data("1A8O.pdb");
  ISOFIELD_SKIP_WITHOUT(path);
  const auto imported = import_file(path, {});
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.read, 644u);
  EXPECT_EQ(imported->report.pieces, 556u);
  EXPECT_FALSE(imported->report.damaged());
  ImportOptions options;
  options.keep_waters = true;
  EXPECT_EQ(import_file(path, options)->report.pieces, 644u);
}

TEST(XyzImport, SegmentTracingParticles) {
  const std::string path = shared_data("segment_tracing_particles.txt");
  ISOFIELD_SKIP_WITHOUT(path);
  const auto imported = import_file(path, {});
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_GE(imported->report.pieces, 1000u);
  EXPECT_EQ(imported->report.pieces, imported->report.read);
}

}  // namespace
}  // namespace isofield
