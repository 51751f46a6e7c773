// Compares the odd files of tests/data/points with the answers beside them.
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>
#include <gtest/gtest.h>

#include "importers/text.h"
#include "isofield/import.h"
#include "isofield/scene_file.h"
#include "points/point_reader.h"
#include "test_support.h"

namespace isofield {
namespace {

constexpr char kFolder[] = ISOFIELD_SOURCE_DIR "/tests/data/points/";

struct Answer {
  std::string file;
  std::vector<float> points;
  std::string note;
  // A part of the error; empty if the file is read.
  std::string message;
};

std::vector<Answer> answers() {
  std::vector<Answer> all;
  const std::string text = read_file(absl::StrCat(kFolder, "answers.txt")).value();
  for (const absl::string_view line : absl::StrSplit(text, '\n', absl::SkipEmpty())) {
    if (line.front() == '#') continue;
    Answer& answer = all.emplace_back();
    const std::size_t blank = line.find(' ');
    answer.file = std::string(line.substr(0, blank));
    const absl::string_view rest = line.substr(blank + 1);
    if (rest.front() == '!') {
      answer.message = std::string(rest.substr(2));
      continue;
    }
    const std::size_t note = rest.find(" # ");
    if (note != absl::string_view::npos) answer.note = std::string(rest.substr(note + 3));
    for (const absl::string_view field : split_fields(rest.substr(1, note - 1))) {
      answer.points.push_back(static_cast<float>(parse_double(field).value()));
    }
  }
  return all;
}

absl::Status read_all(const std::string& path, std::vector<float>& points, std::vector<std::string>& notes) {
  const auto reader = open_points(path);
  if (!reader.ok()) return reader.status();
  for (std::size_t before = 1; before != points.size();) {
    before = points.size();
    if (auto status = (*reader)->read(1, points); !status.ok()) return status;
  }
  notes = (*reader)->notes();
  return absl::OkStatus();
}

TEST(PointFiles, AreReadAsTheirAnswersSay) {
  ASSERT_GT(answers().size(), 70u);
  for (const Answer& answer : answers()) {
    std::vector<float> points;
    std::vector<std::string> notes;
    const absl::Status status = read_all(kFolder + answer.file, points, notes);
    if (!answer.message.empty()) {
      EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << answer.file << ": " << status;
      EXPECT_TRUE(absl::StrContains(status.message(), answer.message)) << status;
      EXPECT_TRUE(absl::StrContains(status.message(), answer.file)) << status;
      continue;
    }
    EXPECT_TRUE(status.ok()) << status;
    EXPECT_EQ(points, answer.points) << answer.file;
    EXPECT_EQ(notes.empty(), answer.note.empty()) << answer.file;
    if (!notes.empty()) {
      EXPECT_TRUE(absl::StrContains(notes[0], answer.note)) << notes[0];
    }
  }
}

// The importer of points reads the same columns.
TEST(PointFiles, AreImportedAsTheyAreRead) {
  for (const Answer& answer : answers()) {
    if (answer.points.empty() || absl::EndsWith(answer.file, ".npy") || answer.file == "named_as_text.csv") continue;
    const auto imported = import_file(kFolder + answer.file, {});
    ASSERT_TRUE(imported.ok()) << imported.status();
    std::vector<float> points;
    for (const v1::Node& node : imported->scene.nodes()) {
      for (const double coordinate : node.sphere().center()) points.push_back(static_cast<float>(coordinate));
    }
    EXPECT_EQ(points, answer.points) << answer.file;
    EXPECT_FALSE(imported->report.damaged()) << imported->report.text();
  }
}

TEST(PointFiles, WithoutTheColumnsCannotBeImported) {
  for (const char* const file : {"no_z.csv", "x_twice.csv", "slice_output.csv"}) {
    const auto imported = import_file(absl::StrCat(kFolder, file), {});
    EXPECT_EQ(imported.status().code(), absl::StatusCode::kInvalidArgument) << file;
    EXPECT_TRUE(absl::StrContains(imported.status().message(), "the columns are ")) << imported.status();
  }
}

}  // namespace
}  // namespace isofield
