#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include "isofield/import.h"
#include "test_support.h"

namespace isofield {
namespace {

constexpr double kSurface = 0.4542020189;  // part of R

absl::StatusOr<Imported> import(const std::string& text, const ImportOptions& options = {}) {
  return import_text(text, ImportFormat::kPoints, options, "p.txt");
}

std::vector<double> soft_radii(const absl::StatusOr<Imported>& imported) {
  std::vector<double> radii;
  for (int i = 0; imported.ok() && i < static_cast<int>(imported->report.pieces); ++i) {
    const v1::Sphere& sphere = imported->scene.nodes(i).sphere();
    EXPECT_NEAR(sphere.radius() / (sphere.radius() + sphere.range()), kSurface, 1e-9);
    radii.push_back(std::round(1e6 * (sphere.radius() + sphere.range())) / 1e6);
  }
  return radii;
}

using Radii = std::vector<double>;

TEST(PointImport, AHeaderNamesTheRadius) {
  EXPECT_EQ(soft_radii(import("x y z radius\n0 0 0 2\n4 0 0 1\n")), (Radii{2, 1}));
  EXPECT_EQ(soft_radii(import("R [um];x;y;z\n2,5;0;0;0\n")), (Radii{2.5}));
  EXPECT_EQ(soft_radii(import("x,y,z,r,g,b\n0,0,0,255,0,0\n")), (Radii{0.5})) << "a colour";
  EXPECT_EQ(soft_radii(import("x,y,z,size\n0,0,0,2\n")), (Radii{0.5}));
}

TEST(PointImport, AnOptionNamesTheRadius) {
  ImportOptions options;
  options.radius_column = "4";
  EXPECT_EQ(soft_radii(import("0 0 0 2\n4 0 0 1\n", options)), (Radii{2, 1}));
  EXPECT_EQ(soft_radii(import("x y z size\n0 0 0 2\n4 0 0 1\n", options)), (Radii{2, 1}));
  options.radius_column = "Size";
  EXPECT_EQ(soft_radii(import("size,x,y,z\n2,0,0,0\n1,4,0,0\n", options)), (Radii{2, 1}));
  const auto refusal = [&](const std::string& text, const std::string& column) {
    options.radius_column = column;
    return std::string(import(text, options).status().message());
  };
  EXPECT_TRUE(absl::StrContains(refusal("x y z s\n0 0 0 2\n", "radius"), "expected one of the columns x, y, z, s"));
  EXPECT_TRUE(absl::StrContains(refusal("0 0 0 2\n", "radius"), "there is no header"));
  EXPECT_TRUE(absl::StrContains(refusal("0 0 0 2\n", "5"), "expected a column from 1 to 4"));
  EXPECT_TRUE(absl::StrContains(refusal("0 0 0 2\n", "0"), "expected a column from 1 to 4"));
  EXPECT_TRUE(absl::StrContains(refusal("0 0 0 2\n", "3"), "holds a coordinate"));
}

TEST(PointImport, RadiiThatCannotBeUsedAreReplacedAndReported) {
  ImportOptions options;
  options.radius = 3;
  const auto imported = import("x,y,z,radius\n0,0,0,0\n0,0,0,-1\n0,0,0,nan\n0,0,0,2\n0,0,0,inf\n", options);
  EXPECT_EQ(soft_radii(imported), (Radii{3, 3, 3, 2, 3}));
  EXPECT_TRUE(absl::StrContains(imported->report.text(), "4 x radius not > 0 or not of a usable size: 3 used"));
}

TEST(PointImport, FurtherColumnsAreMentioned) {
  const auto four = import("0 0 0 2\n4 0 0 1\n");
  EXPECT_EQ(soft_radii(four), (Radii{0.5, 0.5}));
  EXPECT_FALSE(four->report.damaged());
  EXPECT_TRUE(absl::StrContains(four->report.text(), "4 columns, and only the first three are read; the import option"))
      << four->report.text();
  const auto seven = import("0.5 0 0 2 3 4 5\n");
  EXPECT_TRUE(absl::StrContains(seven->report.text(), "is this an SWC file")) << seven->report.text();
  EXPECT_TRUE(import("0 0 0\n")->report.findings.empty());
}

TEST(PointImport, DecimalCommasAreReadBetweenSemicolonsOnly) {
  EXPECT_EQ(import("1,5;2;3\n")->scene.nodes(0).sphere().center(0), 1.5);
  const auto mixed = import("0 0 0\n0,5 1 2\n");
  EXPECT_EQ(mixed->report.pieces, 1u);
  EXPECT_TRUE(absl::StrContains(mixed->report.text(), "decimal commas are read only where semicolons"))
      << mixed->report.text();
  EXPECT_FALSE(import("0,5 1,5 2,5\n").ok());
}

TEST(PointImport, SharedPointsWithRadii) {
  const std::string path = shared_data("odd/points_with_radius.txt");
  ISOFIELD_SKIP_WITHOUT(path);
  ImportOptions options;
  options.radius_column = "4";
  EXPECT_EQ(soft_radii(import_file(path, options)), (Radii{2, 1, 0.5}));
}

}  // namespace
}  // namespace isofield
