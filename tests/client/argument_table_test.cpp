#include "operators/argument_table.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include "operators/argument_columns.h"
#include "test_support.h"

namespace isofield {
namespace {

class ArgumentTableTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::unique_ptr<ArgumentTable>> open(const std::string& text) {
    return ArgumentTable::open(write_file(directory_.path("t.csv"), text));
  }
  // Reads all numbers of the columns at these places.
  absl::StatusOr<std::vector<float>> read(const std::string& text, std::vector<std::size_t> places) {
    auto table = open(text);
    if (!table.ok()) return table.status();
    (*table)->choose(std::move(places));
    std::vector<float> numbers;
    if (auto status = (*table)->read(1000, numbers); !status.ok()) return status;
    return numbers;
  }
  static void expect_refused(const absl::Status& status, const std::vector<std::string>& parts) {
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
    for (const std::string& part : parts) EXPECT_TRUE(absl::StrContains(status.message(), part)) << status;
  }

  TemporaryDirectory directory_;
};

using Numbers = std::vector<float>;

TEST_F(ArgumentTableTest, ReadsColumnsByTheirPlaces) {
  EXPECT_EQ((*open("\xEF\xBB\xBF# note\n\n\"F1\", f2 ,Theta,g\n"))->header(),
            (std::vector<std::string>{"f1", "f2", "theta", "g"}));
  EXPECT_EQ(*read("f1,note,f2\n1,,+2\n# no row\n\n3,a b,4e-1\r\n", {2, 0}), (Numbers{2, 1, 0.4f, 3}));
  EXPECT_EQ(*read("f1;f2\n1;2\n", {0, 1}), (Numbers{1, 2}));
  EXPECT_EQ(*read("f1\tf2\n1\t2", {0, 1}), (Numbers{1, 2}));
  EXPECT_EQ(*read("f1  f2\n1 2\n", {0, 1}), (Numbers{1, 2}));
  EXPECT_EQ(*read("f1,f2\n", {0, 1}), Numbers());
}

TEST_F(ArgumentTableTest, ReadsWhatSpreadsheetsWrite) {
  EXPECT_EQ(*read("f1;f2\n0,5;1e-1\n", {0, 1}), (Numbers{0.5f, 0.1f}));
  EXPECT_EQ(*read("sep=;\r\nf1;f2\r\n0,5;2\r\n", {0, 1}), (Numbers{0.5f, 2}));
  EXPECT_EQ(*read("\xEF\xBB\xBF\"f1\",\"a, b\"\r\"1\",\"x, y\"\r2,\r", {0}), (Numbers{1, 2})) << "CR";
  EXPECT_EQ(*read("f1,f2,\n1,2,\n", {0, 1}), (Numbers{1, 2})) << "trailing separators";
  EXPECT_EQ(*read("% c\nf1 f2\n1 1D-1\n", {0, 1}), (Numbers{1, 0.1f}));
  expect_refused(read("f1 f2\n0,5 1\n", {0, 1}).status(), {"t.csv:2", "\"5 1\"", "column f2"});
}

TEST_F(ArgumentTableTest, AColumnThatIsThereTwiceIsRefused) {
  EXPECT_EQ(*places_of({"f2", "f1"}, {"f1", "note", "note", "f2"}), (std::vector<std::size_t>{3, 0}));
  expect_refused(places_of({"f1"}, {"f1", "f2", "f1"}).status(), {"the columns are f1, f2, f1; expected f1 once"});
}

TEST_F(ArgumentTableTest, ReadsInChunks) {
  auto table = open("f1\n1\n2\n3\n");
  ASSERT_TRUE(table.ok());
  (*table)->choose({0});
  Numbers numbers;
  ASSERT_TRUE((*table)->read(2, numbers).ok());
  EXPECT_EQ(numbers, (Numbers{1, 2}));
  ASSERT_TRUE((*table)->read(2, numbers).ok());
  EXPECT_EQ(numbers, (Numbers{1, 2, 3}));
}

TEST_F(ArgumentTableTest, RefusalsNameTheLine) {
  expect_refused(read("", {0}).status(), {"t.csv:0", "no lines", "header"});
  expect_refused(read("1,2\n", {0}).status(), {"t.csv:1", "\"1\"", "header"});
  expect_refused(read("f1,f2\n1,2\n1,two\n", {0, 1}).status(), {"t.csv:3", "\"two\"", "column f2"});
  expect_refused(read("f1,f2\n1,nan\n", {0, 1}).status(), {"t.csv:2", "\"nan\"", "finite"});
  expect_refused(read("f1,f2\n1,1e39\n", {0, 1}).status(), {"t.csv:2", "finite"});
  expect_refused(read("f1,f2\n1\n", {0, 1}).status(), {"t.csv:2", "1 cells", "expected 2"});
  expect_refused(read("f1,f2\n1,\n", {0, 1}).status(), {"t.csv:2", "column f2"});
  EXPECT_EQ(ArgumentTable::open(directory_.path("none")).status().code(), absl::StatusCode::kNotFound);
}

TEST_F(ArgumentTableTest, RefusalsShowLittleOfTheLineAndNothingThatATerminalObeys) {
  const absl::Status status = read("f1,f2\n1,\x1b[31m" + std::string(5000, 'x') + "\n", {0, 1}).status();
  expect_refused(status, {"t.csv:2", "..."});
  EXPECT_LT(status.message().size(), 250u);
  EXPECT_FALSE(absl::StrContains(status.message(), "\x1b"));
}

}  // namespace
}  // namespace isofield
