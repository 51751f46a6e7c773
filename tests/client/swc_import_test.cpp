#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "isofield/import.h"
#include "test_support.h"

namespace isofield {
namespace {

Imported import_swc_text(const std::string& text, const ImportOptions& options = {}) {
  auto imported = import_text(text, ImportFormat::kSwc, options, "test.swc");
  EXPECT_TRUE(imported.ok()) << imported.status();
  return imported.ok() ? *imported : Imported();
}

std::size_t count_of(const ImportReport& report, const std::string& what) {
  for (const auto& finding : report.findings) {
    if (absl::StrContains(finding.what, what)) return finding.count;
  }
  return 0;
}

TEST(SwcImport, AnEdgeIsASegmentFromParentToSample) {
  const auto [scene, report] = import_swc_text("1 3 0 0 0 2 -1\n2 3 10 0 0 1 1\n3 3 10 5 0 0.5 2\n");
  ASSERT_EQ(scene.nodes_size(), 3);
  const auto& segment = scene.nodes(0).segment();
  EXPECT_EQ(segment.a(0), 0);
  EXPECT_EQ(segment.b(0), 10);
  EXPECT_EQ(segment.radius_a(), 2);
  EXPECT_EQ(segment.radius_b(), 1);
  EXPECT_EQ(segment.range(), 2);
  EXPECT_EQ(scene.nodes(0).name(), "n2");
  EXPECT_EQ(scene.nodes(2).gradient().opening().preset(), v1::Opening::CAMEL);
  EXPECT_EQ(scene.nodes(2).gradient().children(1), "#1");
  EXPECT_EQ(scene.root(), "model");
  EXPECT_FALSE(report.damaged());
}

TEST(SwcImport, IsInMicrometresUnlessStatedOtherwise) {
  const std::string text = "1 3 0 0 0 2 -1\n2 3 10 0 0 1 1\n";
  EXPECT_EQ(import_swc_text(text).scene.unit(), "um");
  EXPECT_EQ(import_swc_text(text, {.unit = "8 nm"}).scene.unit(), "8 nm");
}

TEST(SwcImport, TheSomaIsASphereAndProcessesDoNotTaperFromIt) {
  const auto [scene, report] = import_swc_text("1 1 0 0 0 5 -1\n2 3 6 0 0 1 1\n3 3 9 0 0 1 2\n");
  ASSERT_EQ(scene.nodes_size(), 4);
  EXPECT_EQ(scene.nodes(0).sphere().radius(), 5);
  EXPECT_EQ(scene.nodes(1).segment().radius_a(), 1);
}

TEST(SwcImport, ASomaOfThreeSamplesIsOneSphere) {
  const auto [scene, report] = import_swc_text("1 1 0 0 0 5 -1\n2 1 0 -5 0 5 1\n3 1 0 5 0 5 1\n4 3 6 0 0 1 1\n");
  ASSERT_EQ(scene.nodes_size(), 3);
  EXPECT_TRUE(scene.nodes(0).has_sphere());
  EXPECT_TRUE(scene.nodes(1).has_segment());
  EXPECT_EQ(count_of(report, "diameter of the soma"), 2u);
  EXPECT_FALSE(report.damaged());
}

TEST(SwcImport, ALoneSampleIsTheWholeScene) {
  const auto [scene, report] = import_swc_text("7 1 1 2 3 4 -1\n");
  ASSERT_EQ(scene.nodes_size(), 1);
  EXPECT_EQ(scene.nodes(0).sphere().center(2), 3);
  EXPECT_EQ(scene.root(), "");
}

TEST(SwcImport, ReadsCommentsBlankLinesCrLfAndNoEndOfLastLine) {
  const auto [scene, report] =
      import_swc_text("\xEF\xBB\xBF# c\r\n\r\n  1 0 0 0 0 1 -1 \r\n#x\r\n2\t0\t+4\t0\t0\t1\t1");
  EXPECT_EQ(scene.nodes_size(), 1);
  EXPECT_FALSE(report.damaged()) << report.text();
}

TEST(SwcImport, DropsWhatCannotBeUsedAndSaysSo) {
  const auto [scene, report] = import_swc_text(
      "1 0 0 0 0 1 -1\n"
      "garbage\n"
      "2 0 nan 0 0 1 1\n"    // the sample is dropped, and its child becomes a root
      "3 0 1e300 0 0 1 1\n"  // the coordinate is beyond float32
      "4 0 5 0 0 1 2\n"
      "5 0 9 0 0 1 4\n"
      "5 0 9 9 9 1 4\n"   // the id was used before
      "6 0 9 5 0 1 77\n"  // there is no such parent
      "7 0 1 2\n"
      "8 0 0 3 0 1 x\n");
  EXPECT_EQ(count_of(report, "expected \"id type x y z radius parent\""), 2u);
  EXPECT_EQ(count_of(report, "a coordinate is not a finite number"), 2u);
  EXPECT_EQ(count_of(report, "id was used before"), 1u);
  EXPECT_EQ(count_of(report, "parent is not in the file"), 2u);
  EXPECT_EQ(count_of(report, "parent is not a whole number"), 1u);
  EXPECT_EQ(count_of(report, "separate tree"), 4u);
  EXPECT_TRUE(report.damaged());
  EXPECT_TRUE(absl::StrContains(report.text(), "line 2: garbage")) << report.text();
  // The samples 1, 6 and 8 are alone and become spheres; 5 is an edge from 4.
  EXPECT_EQ(scene.nodes_size(), 4 + 1);
}

TEST(SwcImport, MendsRadiiFromTheParentOrTheOption) {
  const std::string text = "1 0 0 0 0 0 -1\n2 0 9 0 0 -3 1\n3 0 18 0 0 2 2\n4 0 27 0 0 nan 3\n5 0 36 0 0 0.1 4\n";
  const auto [scene, report] = import_swc_text(text);
  EXPECT_EQ(count_of(report, "nearest descendant"), 1u);
  EXPECT_EQ(count_of(report, "gets its parent's"), 2u);
  // The radius is never the least one of the file, 0.1.
  EXPECT_EQ(scene.nodes(0).segment().radius_a(), 2);
  EXPECT_EQ(scene.nodes(0).segment().radius_b(), 2);
  EXPECT_EQ(scene.nodes(2).segment().radius_b(), 2);
  EXPECT_EQ(scene.nodes(3).segment().radius_b(), 0.1);
  const auto floored = import_swc_text(text, {.min_radius = 0.5});
  EXPECT_EQ(floored.scene.nodes(0).segment().radius_a(), 0.5);
  EXPECT_EQ(floored.scene.nodes(3).segment().radius_b(), 0.5);
  EXPECT_EQ(count_of(floored.report, "gets the import option min_radius"), 3u);
  EXPECT_EQ(count_of(floored.report, "thinner than the import option min_radius"), 1u);
  const auto none = import_text("1 0 0 0 0 0 -1\n", ImportFormat::kSwc, {}, "test.swc");
  EXPECT_EQ(none.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(absl::StrContains(none.status().message(), "line 1: 1 0 0 0 0 0 -1")) << none.status();
  EXPECT_TRUE(absl::StrContains(none.status().message(), "import option min_radius")) << none.status();
}

TEST(SwcImport, ProcessesOfAContourMeetItsSurface) {
  std::string text;
  for (int i = 0; i < 24; ++i) {
    const double turn = i * 0.2617993877991494;
    absl::StrAppend(&text, i + 1, " 1 ", 12 * std::cos(turn), " ", 5 * std::sin(turn), " 3 0 ", i == 0 ? -1 : i, "\n");
  }
  absl::StrAppend(&text, "30 3 20 9 7 1 1\n");
  const auto [scene, report] = import_swc_text(text);
  ASSERT_EQ(report.pieces, 2u);
  EXPECT_NEAR(scene.nodes(0).ellipsoid().semi_axes(0), 12, 1e-3);
  EXPECT_NEAR(scene.nodes(0).ellipsoid().semi_axes(1), 5, 1e-3);
  EXPECT_NEAR(scene.nodes(0).ellipsoid().semi_axes(2), 8.5, 1e-3);
  const auto& start = scene.nodes(1).segment().a();
  EXPECT_NEAR(std::hypot(start[0] / 12, start[1] / 5, (start[2] - 3) / 8.5), 1, 1e-4);
}

TEST(SwcImport, EveryLengthIsOneThatTheServerTakes) {
  // These are the ends of the range of coordinates and radii. Segments may not be longer than 1e9.
  const auto [scene, report] = import_swc_text(
      "1 3 -2.5e8 -2.5e8 -2.5e8 1e-9 -1\n2 3 2.5e8 2.5e8 2.5e8 2.5e8 1\n3 3 2.6e8 0 0 1 2\n4 3 0 0 0 1e-10 2\n",
      {.range_factor = 1e-5});
  EXPECT_EQ(count_of(report, "a coordinate is not"), 1u);
  EXPECT_EQ(count_of(report, "without a radius > 0 that a scene can hold"), 1u);
  for (const auto& node : scene.nodes()) {
    if (!node.has_segment()) continue;
    const auto& s = node.segment();
    EXPECT_LE(std::hypot(s.a(0) - s.b(0), s.a(1) - s.b(1), s.a(2) - s.b(2)), 1e9);
    EXPECT_GE(s.range(), 1e-9);
    EXPECT_GE(std::min(s.radius_a(), s.radius_b()), 1e-9);
  }
}

TEST(SwcImport, ATextThatHoldsANeuronIsReadAsOne) {
  const TemporaryDirectory folder;
  const std::string neuron = write_file(folder.path("neuron.txt"), "# a\n1 1 +0.0e+00 0 0 6.0 -1\n2 3 0 8 0 1.2 1\n");
  EXPECT_EQ(import_file(neuron, {})->report.format, "neuron (SWC)");
  const std::string points = write_file(folder.path("points.txt"), "1 1 0\n2 3 0\n");
  EXPECT_EQ(import_file(points, {})->report.format, "points (XYZ)");
}

TEST(SwcImport, CutsCyclesOnce) {
  const auto [scene, report] =
      import_swc_text("1 0 0 0 0 1 3\n2 0 9 0 0 1 1\n3 0 9 9 0 1 2\n4 0 9 18 0 1 3\n5 0 50 0 0 1 5\n6 0 60 0 0 1 5\n");
  EXPECT_EQ(count_of(report, "its own ancestor"), 1u);
  EXPECT_EQ(count_of(report, "is its own parent"), 1u);
  // The edges 1-2, 2-3, 3-4 and 5-6 remain; the one that closes the cycle is gone.
  EXPECT_EQ(report.pieces, 4u);
}

TEST(SwcImport, DropsEdgesWithoutLength) {
  const auto [scene, report] =
      import_swc_text("1 0 0 0 0 1 -1\n2 0 0 0 0 1 1\n3 0 9 0 0 1 2\n4 0 9 0 0 4 3\n5 0 50 0 0 1 -1\n6 0 50 0 0 2 5\n");
  EXPECT_EQ(count_of(report, "edge of length 0 dropped"), 2u);
  EXPECT_EQ(count_of(report, "made a sphere"), 1u);
  // The pieces are the edge 2-3, the wide end 4, and the tree 5-6 as one sphere of its larger radius.
  ASSERT_EQ(report.pieces, 3u);
  EXPECT_EQ(scene.nodes(1).sphere().radius(), 4);
  EXPECT_EQ(scene.nodes(2).sphere().radius(), 2);
}

TEST(SwcImport, PutsParentsBeforeChildren) {
  const auto [scene, report] =
      import_swc_text("3 0 18 0 0 1 2\n2 0 9 0 0 1 1\n4 0 9 9 0 1 2\n1 0 0 0 0 1 -1\n5 0 9 18 0 1 4\n");
  std::string order;
  for (const auto& node : scene.nodes()) absl::StrAppend(&order, node.name(), " ");
  EXPECT_EQ(order, "n2 n3 n4 n5 model ");
}

TEST(SwcImport, OptionsChooseOperatorAndRange) {
  ImportOptions options;
  options.range_factor = 0.25;
  options.op = ImportOperator::kContact;
  const std::string text = "1 0 0 0 0 4 -1\n2 0 9 0 0 4 1\n3 0 18 0 0 4 2\n";
  auto scene = import_swc_text(text, options).scene;
  EXPECT_EQ(scene.nodes(0).segment().range(), 1);
  EXPECT_EQ(scene.nodes(2).gradient().silhouette().k(), 0.8);
  options.range = 7;
  options.op = ImportOperator::kMax;
  scene = import_swc_text(text, options).scene;
  EXPECT_EQ(scene.nodes(1).segment().range(), 7);
  EXPECT_EQ(scene.nodes(2).max().children_size(), 2);
  options.range = -1;
  EXPECT_EQ(import_text(text, ImportFormat::kSwc, options, "x").status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(SwcImport, NothingUsableIsAnError) {
  for (const char* text : {"", "# only a comment\n", "\n\n", "a b c d e f g\n", "\0\1\2\3"}) {
    EXPECT_EQ(import_text(text, ImportFormat::kSwc, {}, "bad.swc").status().code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST(SwcImport, LongChainsAndLongCyclesTakeLinearTime) {
  // Children come before parents, so the order has to be made. In the second round all samples are one cycle.
  for (const bool cycle : {false, true}) {
    constexpr int kSamples = 200000;
    std::string text;
    for (int i = kSamples; i >= 1; --i) {
      absl::StrAppend(&text, i, " 0 ", 3 * i, " 0 0 1 ", i == 1 ? (cycle ? kSamples : -1) : i - 1, "\n");
    }
    const double start = processor_seconds();
    EXPECT_EQ(import_swc_text(text).report.pieces, kSamples - 1u);
    EXPECT_LT(processor_seconds() - start, 5);
  }
}

TEST(SwcImport, HemibrainNeuron) {
  const std::string path = shared_data("hemibrain_1734350788.swc");
  ISOFIELD_SKIP_WITHOUT(path);
  const auto imported = import_file(path, {});
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.read, 4465u);
  // The pieces are 4,464 edges and the soma, less three edges within it.
  EXPECT_EQ(imported->report.pieces, 4462u);
  EXPECT_EQ(count_of(imported->report, "is the unit nm? The import option unit"), 1u);
  EXPECT_FALSE(imported->report.damaged());
}

TEST(SwcImport, NeuromNeuron) {
  const std::string path = shared_data("neurom_synthetic.swc");
  ISOFIELD_SKIP_WITHOUT(path);
  const auto imported = import_file(path, {});
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.read, 847u);
  EXPECT_EQ(count_of(imported->report, "edge of length 0 dropped"), 4u);
  // The pieces are 846 edges less those four; the soma is a stack of two.
  EXPECT_EQ(imported->report.pieces, 842u);
}

}  // namespace
}  // namespace isofield
