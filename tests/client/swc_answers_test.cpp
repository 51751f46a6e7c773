// Compares the files of tests/data/swc, one for each peculiarity of neurons' files, with answers.json beside them.
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/str_join.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "isofield/import.h"
#include "isofield/scene_file.h"

namespace isofield {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;
using Numbers = google::protobuf::RepeatedField<double>;

const std::filesystem::path kFolder = std::filesystem::path(ISOFIELD_SOURCE_DIR) / "tests/data/swc";

std::string words(const Numbers& numbers) {
  return absl::StrJoin(numbers, " ", [](std::string* out, double number) {
    // Rounding may leave a negative zero.
    absl::StrAppendFormat(out, "%.4g", std::abs(number) < 1e-12 ? 0.0 : number);
  });
}

std::string words(double number) {
  return absl::StrFormat("%.4g", number);
}

// Describes a piece, such as "n2 segment (0 0 0) 2 to (9 0 0) 1". The place of a transformed shape is its translation.
std::string describe(const v1::Scene& scene, const v1::Node& node) {
  const std::string& text = node.name();
  if (node.has_transform()) {
    const Numbers& matrix = node.transform().matrix();
    const int child = std::stoi(node.transform().child().substr(1));
    const std::array<double, 3> place = {matrix[3], matrix[7], matrix[11]};
    return absl::StrCat(text, " at (", words(Numbers(place.begin(), place.end())), ")",
                        describe(scene, scene.nodes(child)));
  }
  if (node.has_sphere()) {
    return absl::StrCat(text, " sphere (", words(node.sphere().center()), ") ", words(node.sphere().radius()));
  }
  if (node.has_ellipsoid()) {
    return absl::StrCat(text, " ellipsoid (", words(node.ellipsoid().center()), ") ",
                        words(node.ellipsoid().semi_axes()));
  }
  const v1::Segment& segment = node.segment();
  return absl::StrCat(text, " segment (", words(segment.a()), ") ", words(segment.radius_a()), " to (",
                      words(segment.b()), ") ", words(segment.radius_b()));
}

std::vector<std::string> describe_pieces(const v1::Scene& scene) {
  std::vector<std::string> pieces;
  for (int i = 0; i < scene.nodes_size(); ++i) {
    const v1::Node& node = scene.nodes(i);
    if (node.name() == "model") continue;
    if (node.has_transform()) pieces.pop_back();
    pieces.push_back(describe(scene, node));
  }
  return pieces;
}

std::size_t count_trees(const ImportReport& report) {
  for (const auto& finding : report.findings) {
    if (absl::StartsWith(finding.what, "separate tree")) return finding.count;
  }
  return 1;
}

std::vector<std::string> strings(const Value& list) {
  std::vector<std::string> result;
  for (const Value& value : list.list_value().values()) result.push_back(value.string_value());
  return result;
}

ImportOptions options_of(const Struct& answer) {
  ImportOptions options;
  const auto& stated = answer.fields();
  if (stated.contains("min_radius")) options.min_radius = stated.at("min_radius").number_value();
  if (stated.contains("apply_scale")) options.apply_scale = stated.at("apply_scale").bool_value();
  if (stated.contains("unit")) options.unit = stated.at("unit").string_value();
  return options;
}

void check(const std::string& file, const Struct& answer) {
  const auto imported = import_file(kFolder / file, options_of(answer));
  const auto& stated = answer.fields();
  if (stated.contains("error")) {
    EXPECT_EQ(imported.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_TRUE(absl::StrContains(imported.status().message(), stated.at("error").string_value())) << imported.status();
    return;
  }
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->report.read, stated.at("read").number_value());
  EXPECT_EQ(count_trees(imported->report), stated.at("trees").number_value());
  const auto pieces = describe_pieces(imported->scene);
  EXPECT_EQ(imported->report.pieces, pieces.size());
  EXPECT_EQ(pieces, strings(stated.at("pieces"))) << absl::StrJoin(pieces, "\n");
  std::vector<std::string> findings;
  for (const auto& finding : imported->report.findings) {
    findings.push_back(absl::StrCat(finding.count, finding.damage ? " ! " : " - ", finding.what));
    if (finding.damage) findings.back() += absl::StrCat(" | ", finding.examples.front());
  }
  EXPECT_EQ(findings, strings(stated.at("findings"))) << absl::StrJoin(findings, "\n");
}

TEST(SwcAnswers, EveryFileGivesItsAnswer) {
  const auto text = read_file(kFolder / "answers.json");
  ASSERT_TRUE(text.ok()) << text.status();
  Struct answers;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(*text, &answers).ok());
  std::set<std::string> answered;
  for (const auto& [title, answer] : answers.fields()) {
    SCOPED_TRACE(title);
    const std::string file = title.substr(0, title.find(' '));
    answered.insert(file);
    check(file, answer.struct_value());
  }
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::string file = entry.path().filename();
    EXPECT_TRUE(file == "answers.json" || answered.contains(file)) << file << " has no answer";
  }
}

}  // namespace
}  // namespace isofield
