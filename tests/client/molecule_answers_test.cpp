// Compares the files of tests/data/molecules with the answers beside them.
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "gzip.h"
#include "importers/elements.h"
#include "importers/mmcif_assembly.h"
#include "isofield/import.h"
#include "isofield/scene_file.h"
#include "test_support.h"

namespace isofield {
namespace {

const std::string kFolder = ISOFIELD_SOURCE_DIR "/tests/data/molecules/";

struct Answer {
  std::string file;
  std::vector<std::string> options, elements, center;
  std::string words;
};

std::vector<Answer> read_answers() {
  std::vector<Answer> answers;
  for (const absl::string_view line : absl::StrSplit(*read_file(kFolder + "answers.txt"), '\n', absl::SkipEmpty())) {
    if (line[0] == '#') continue;
    std::vector<std::string> columns;
    for (const absl::string_view column : absl::StrSplit(line, '|')) {
      columns.emplace_back(absl::StripAsciiWhitespace(column));
    }
    columns.resize(5);
    const auto words = [&](std::size_t column) {
      return std::vector<std::string>(absl::StrSplit(columns[column], ' ', absl::SkipEmpty()));
    };
    answers.push_back({columns[0], words(1), words(2), words(3), columns[4]});
  }
  return answers;
}

ImportOptions options_of(const std::vector<std::string>& words) {
  ImportOptions options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = [&] { return i + 1 < words.size() ? words[++i] : std::string(); };
    if (words[i] == "--waters") {
      options.keep_waters = true;
    } else if (words[i] == "--no-hydrogens") {
      options.keep_hydrogens = false;
    } else if (words[i] == "--altloc") {
      options.altloc = value();
    } else if (words[i] == "--assembly") {
      options.assembly = value();
    } else if (words[i] == "--chain") {
      options.chains = absl::StrSplit(value(), ',');
    } else if (words[i] == "--model" || words[i] == "--frame") {
      options.frame = std::stoi(value());
    } else {
      ADD_FAILURE() << "no such option: " << words[i];
    }
  }
  return options;
}

int pieces_of(const v1::Scene& scene) {
  return scene.nodes_size() - (scene.root() == "model" ? 1 : 0);
}

void expect_elements(const Answer& answer, const v1::Scene& scene) {
  if (answer.elements[0] == "points") {
    EXPECT_EQ(pieces_of(scene), std::stoi(answer.elements[1]));
    return;
  }
  ASSERT_EQ(pieces_of(scene), static_cast<int>(answer.elements.size()));
  for (int i = 0; i < pieces_of(scene); ++i) {
    const Element* const element = find_element(answer.elements[static_cast<std::size_t>(i)]);
    ASSERT_NE(element, nullptr);
    EXPECT_EQ(scene.nodes(i).sphere().radius(), element->radius > 0 ? element->radius : kUnknownElementRadius)
        << element->symbol << ", atom " << i;
  }
}

TEST(MoleculeAnswers, EachFileHasItsAnswer) {
  const auto answers = read_answers();
  ASSERT_GE(answers.size(), 80u);
  for (const Answer& answer : answers) {
    SCOPED_TRACE(answer.file + " " + absl::StrJoin(answer.options, " "));
    const auto imported = import_file(kFolder + answer.file, options_of(answer.options));
    const std::string said = imported.ok() ? imported->report.text() : std::string(imported.status().message());
    EXPECT_TRUE(absl::StrContains(said, answer.words)) << said;
    ASSERT_FALSE(answer.elements.empty());
    ASSERT_EQ(imported.ok(), answer.elements[0] != "error") << said;
    if (!imported.ok()) continue;
    expect_elements(answer, imported->scene);
    const v1::Sphere& last = imported->scene.nodes(pieces_of(imported->scene) - 1).sphere();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(last.center(axis), std::stod(answer.center[static_cast<std::size_t>(axis)]), 2e-6) << axis;
    }
  }
}

// An import of damaged bytes yields an error that names the file, or spheres that a server accepts.
void expect_error_or_scene(const absl::StatusOr<Imported>& imported) {
  if (!imported.ok()) {
    EXPECT_EQ(imported.status().code(), absl::StatusCode::kInvalidArgument) << imported.status();
    EXPECT_TRUE(absl::StartsWith(imported.status().message(), "changed: ")) << imported.status();
    return;
  }
  const v1::Scene& scene = imported->scene;
  ASSERT_GT(pieces_of(scene), 0);
  EXPECT_EQ(imported->report.pieces, static_cast<std::size_t>(pieces_of(scene)));
  std::set<std::string> names;
  for (int i = 0; i < pieces_of(scene); ++i) {
    const v1::Sphere& sphere = scene.nodes(i).sphere();
    ASSERT_EQ(sphere.center_size(), 3) << "piece " << i;
    for (const double x : sphere.center()) ASSERT_TRUE(std::isfinite(x)) << "piece " << i << ": " << x;
    ASSERT_TRUE(sphere.radius() > 0 && std::isfinite(sphere.radius())) << "piece " << i << ": " << sphere.radius();
    ASSERT_TRUE(sphere.range() > 0 && std::isfinite(sphere.range())) << "piece " << i << ": " << sphere.range();
    const std::string& name = scene.nodes(i).name();
    ASSERT_TRUE(name.empty() || names.insert(name).second) << "two pieces are called " << name;
  }
}

TEST(MoleculeAnswers, ChangedBytesAreAnErrorOrAScene) {
  std::uint32_t random = 1;
  int scenes = 0, errors = 0;
  for (const Answer& answer : read_answers()) {
    const auto text = read_file(kFolder + answer.file);
    if (!text.ok() || text->empty()) continue;
    for (int round = 0; round < 40; ++round) {
      SCOPED_TRACE(absl::StrCat(answer.file, ", round ", round));
      std::string changed = *text;
      for (int change = 0; change <= round % 4; ++change) {
        random = random * 1664525u + 1013904223u;
        changed[random % changed.size()] = "\0\t\r\n -.9AH#_;'\"\xff("[(random >> 24) % 17];
      }
      if (round % 5 == 0) changed.resize(random % changed.size());
      const auto imported = import_text(changed, *import_format(answer.file), options_of(answer.options), "changed");
      expect_error_or_scene(imported);
      ++(imported.ok() ? scenes : errors);
    }
  }
  EXPECT_GT(scenes, 1000);
  EXPECT_GT(errors, 100);
}

TEST(MoleculeAnswers, NamesInAssembliesCountTheCopies) {
  ImportOptions options;
  options.assembly = "1";
  const auto imported = import_file(kFolder + "assembly.pdb", options);
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->scene.nodes(0).name(), "A/GLY1/N");
  EXPECT_EQ(imported->scene.nodes(1).name(), "A-2/GLY1/N");
}

TEST(MoleculeAnswers, OperatorExpressions) {
  using Products = std::vector<std::vector<std::string>>;
  EXPECT_EQ(*expand_operators("1,2"), (Products{{"1"}, {"2"}}));
  EXPECT_EQ(*expand_operators("(X0)(1-3,P)"), (Products{{"X0", "1"}, {"X0", "2"}, {"X0", "3"}, {"X0", "P"}}));
  EXPECT_EQ(*expand_operators("(1,2)(3,4)"), (Products{{"1", "3"}, {"1", "4"}, {"2", "3"}, {"2", "4"}}));
  for (const char* bad : {"(1", "(1-2000000000)", "(1-1000)(1-1000)", "5-1"}) EXPECT_FALSE(expand_operators(bad).ok());
}

TEST(Gzip, BoundsAndDamage) {
  const TemporaryDirectory directory;
  const auto packed = [] {
    // This reads the packed bytes as they are, so that gunzip() unpacks them.
    FILE* const file = std::fopen((kFolder + "packed.pdb.gz").c_str(), "rb");
    std::string data(4096, '\0');
    data.resize(std::fread(data.data(), 1, data.size(), file));
    std::fclose(file);
    return data;
  }();
  const auto whole = gunzip(packed);
  ASSERT_TRUE(whole.ok()) << whole.status();
  EXPECT_TRUE(gunzip(packed, whole->size()).ok());
  const auto bounded = gunzip(packed, whole->size() - 1);
  EXPECT_EQ(bounded.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_TRUE(absl::StrContains(bounded.status().message(), "when unpacked")) << bounded.status();
  EXPECT_EQ(*gunzip(packed + std::string(512, '\0')), *whole);
  EXPECT_FALSE(gunzip(packed + "more").ok());
  EXPECT_FALSE(gunzip(packed.substr(0, packed.size() - 1)).ok());
  // A packed file is known by its content, whatever its name is.
  EXPECT_EQ(*read_file(write_file(directory.path("plain"), packed)), *whole);
}

}  // namespace
}  // namespace isofield
