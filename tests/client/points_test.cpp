#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cstring>

#include "excerpt.h"
#include "isofield/scene_file.h"
#include "points/point_reader.h"
#include "points/result_writer.h"
#include "points/table.h"
#include "test_support.h"

namespace isofield {
namespace {

class PointsTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::vector<float>> read(const std::string& name, std::string_view data, std::size_t chunk = 1000) {
    auto reader = open_points(write_file(directory_.path(name), data));
    if (!reader.ok()) return reader.status();
    std::vector<float> all;
    for (std::size_t before = 1; before != all.size();) {
      before = all.size();
      if (auto status = (*reader)->read(chunk, all); !status.ok()) return status;
      EXPECT_LE(all.size() - before, 3 * chunk);
    }
    return all;
  }

  std::string error(const std::string& name, std::string_view data) {
    const auto result = read(name, data);
    EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument) << name;
    return std::string(result.status().message());
  }

  static std::string npy(const std::string& descr, const std::string& shape, std::string_view data, char version = 1,
                         const std::string& order = "False") {
    const std::string header = "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
    std::string out("\x93NUMPY", 6);
    out.push_back(version);
    out.push_back('\0');
    out.push_back(static_cast<char>(header.size()));
    out.append(version == 1 ? 1 : 3, '\0');
    return out + header + std::string(data);
  }

  template <typename T>
  static std::string bytes(const std::vector<T>& numbers) {
    return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
  }

  TemporaryDirectory directory_;
};

using Floats = std::vector<float>;

TEST_F(PointsTest, TextInItsForms) {
  const Floats two = {1, -2.5f, 3e-3f, 4, 5, 6};
  EXPECT_EQ(*read("a.csv", "x,y,z\n1,-2.5,3e-3\n4,5,6\n"), two);
  EXPECT_EQ(*read("a.csv", "1 -2.5\t+3e-3\r\n\r\n# c\r\n  4 ; 5 , 6 \r\n"), two);
  EXPECT_EQ(*read("a.csv", "1,-2.5,3e-3\n4,5,6"), two);
  EXPECT_EQ(*read("a.csv", "\xEF\xBB\xBFx,y,z,value\n1,-2.5,3e-3,9\n4,5,6,9\n", 1), two);
  EXPECT_EQ(*read("a.csv", ""), Floats());
  EXPECT_EQ(*read("a.csv", "x,y,z\n"), Floats());
}

TEST_F(PointsTest, BadTextNamesFileLineAndExpectation) {
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,3\n1,2\n"), "a.csv:2: \"1,2\": expected three numbers x,y,z"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "x y z\n\nu v w\n"), "a.csv:3:"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,3\n4,nan,6\n"), "a.csv:2: \"4,nan,6\": expected finite"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,inf\n"), "finite"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,1e39\n"), "finite"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,1e999\n"), "finite"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,3 4\n"), "expected three numbers"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,3x\n"), "expected three numbers"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "1,2,3\n" + std::string(2 << 20, '1')), "a.csv:2: a line longer"));
}

TEST_F(PointsTest, ExcerptsAreShortAndPrintable) {
  EXPECT_EQ(excerpt("1, 2"), "1, 2");
  EXPECT_EQ(excerpt("a\tb\x1b[0m\xc3\xa9"), "a b?[0m??");
  EXPECT_EQ(excerpt(std::string(80, 'x')), std::string(80, 'x'));
  EXPECT_EQ(excerpt(std::string(5000, 'x')), std::string(77, 'x') + "...");
}

TEST_F(PointsTest, TextLongerThanABlock) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 300000; ++i) absl::StrAppend(&text, i, ",", 2 * i, ",-1\n");
  const auto points = read("a.csv", text, 65536);
  ASSERT_TRUE(points.ok()) << points.status();
  ASSERT_EQ(points->size(), 900000u);
  for (int i = 0; i < 300000; ++i) ASSERT_EQ((*points)[3 * i + 1], static_cast<float>(2 * i));
}

TEST_F(PointsTest, LinesEndAtLfOrCrAndMayCrossBlocks) {
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    std::string text = "x,y,z";
    for (int i = 0; i < 150000; ++i) absl::StrAppend(&text, end, i, ",", 2 * i, ",-1");
    const auto points = read("a.csv", text, 65536);
    ASSERT_TRUE(points.ok()) << points.status();
    ASSERT_EQ(points->size(), 450000u);
    for (int i = 0; i < 150000; ++i) ASSERT_EQ((*points)[3 * i + 1], static_cast<float>(2 * i));
  }
  EXPECT_TRUE(absl::StrContains(error("a.csv", "x,y,z\r1,2,3\r4,5,f\r"), "a.csv:3:"));
  EXPECT_TRUE(absl::StrContains(error("a.csv", "x,y,z\r\n\r\n4,5,f\r\n"), "a.csv:3:"));
}

TEST_F(PointsTest, RaysAreFoundByTheNamesOfTheirColumns) {
  const auto vectors = [&](const std::string& text, VectorRole role, bool is_second = false) {
    auto reader = open_points(write_file(directory_.path("r.csv"), text), {role, is_second});
    Floats xyz;
    const absl::Status status = reader.ok() ? (*reader)->read(10, xyz) : reader.status();
    return status.ok() ? xyz : Floats();
  };
  using enum VectorRole;
  const std::string rays = "dx,dy,dz,ox,oy,oz\n1,2,3,4,5,6\n", hits = "x,y,z,nx,ny,nz\n1,2,3,4,5,6\n";
  EXPECT_EQ(vectors(rays, kOrigin), (Floats{4, 5, 6}));
  EXPECT_EQ(vectors(rays, kDirection, true), (Floats{1, 2, 3}));
  EXPECT_EQ(vectors(rays, kPosition), Floats());
  EXPECT_EQ(vectors(hits, kOrigin), (Floats{1, 2, 3}));
  EXPECT_EQ(vectors(hits, kDirection, true), (Floats{4, 5, 6}));
  EXPECT_EQ(vectors("x,y,z\n1,2,3\n", kDirection), (Floats{1, 2, 3}));
  EXPECT_EQ(vectors("x,y,z\n1,2,3\n", kDirection, true), Floats()) << "they are the origins";
  EXPECT_EQ(vectors("1 2 3 4 5 6\n", kOrigin), (Floats{1, 2, 3}));
  EXPECT_EQ(vectors("1 2 3 4 5 6\n", kDirection, true), (Floats{4, 5, 6}));
  EXPECT_EQ(vectors("1 2 3\n", kDirection, true), Floats());
}

TEST_F(PointsTest, NumpyArrays) {
  const Floats two = {1, 2, 3, 4, 5, 6};
  const std::vector<double> doubles(two.begin(), two.end());
  EXPECT_EQ(*read("a.npy", npy("<f4", "(2, 3)", bytes(two))), two);
  EXPECT_EQ(*read("a.npy", npy("<f8", "(2, 3)", bytes(doubles), 2), 1), two);
  EXPECT_EQ(*read("a.npy", npy("<f8", "(2,3)", bytes(doubles), 3)), two);
  EXPECT_EQ(*read("a.npy", npy("<f4", "(2L, 3L)", bytes(two))), two);
  EXPECT_EQ(*read("a.npy", npy("<f4", "(0, 3)", "")), Floats());
  EXPECT_EQ(*read("a.npy", npy("<f4", "(2, 3)", bytes(Floats{1, 4, 2, 5, 3, 6}), 1, "True"), 1), two);
}

TEST_F(PointsTest, BadNumpyArraysAreRefused) {
  const std::string data = bytes(Floats{1, 2, 3, 4, 5, 6});
  EXPECT_TRUE(absl::StrContains(error("a.npy", "1,2,3\n"), "not a NumPy array"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", ""), "not a NumPy array"));
  for (const char* type : {"<c8", "<f16", "|O", "|S4", "<M8[ns]", "", "<", "f", "<f99999999999"}) {
    EXPECT_TRUE(absl::StrContains(error("a.npy", npy(type, "(2, 3)", data)), "expected numbers")) << type;
  }
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(3, 2)", data)), "expected (n, 3)"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(6,)", data)), "expected (n, 3)"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(2, 3, 1)", data)), "expected (n, 3)"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "()", data)), "expected (n, 3)"));
  for (const char* shape : {"(-2, 3)", "(", "(99999999999999999999, 3)", "6", "(2, 'a')", "((2,), 3)"}) {
    EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", shape, data)), "damaged")) << shape;
  }
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(2, 3)", data, 1, "Maybe")), "damaged"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", std::string(100, '('), data)), "damaged"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(2, 3)", data, 9)), "version"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(3, 3)", data)), "cut off"));
  EXPECT_TRUE(absl::StrContains(error("a.npy", npy("<f4", "(2, 3)", data).substr(0, 20)), "cut off"));
  EXPECT_TRUE(
      absl::StrContains(error("a.npy", npy("<f8", "(1, 3)", bytes(std::vector<double>{0, 1e300, 0}))), "row 0"));
}

TEST_F(PointsTest, TablesAreReadAgainByTheirNames) {
  const Floats xyz = {0.1f, 2, -3, 4, 5, 6}, distances = {1, 2};
  for (const char* const name : {"t.csv", "t.npy"}) {
    Table table;
    table.add("distance", std::span<const float>(distances));
    table.add_vectors({"x", "y", "z"}, xyz);
    table.add_texts("node", {"a, \"b\"", ""});
    auto file = OutputFile::create(directory_.path(name));
    ASSERT_TRUE(table.write(name, **file).ok() && (*file)->commit().ok());
    auto reader = open_points(directory_.path(name));
    ASSERT_TRUE(reader.ok()) << reader.status();
    Floats again;
    ASSERT_TRUE((*reader)->read(10, again).ok());
    EXPECT_EQ(again, xyz) << name;
  }
}

TEST_F(PointsTest, ATableWithoutRowsHasTheFieldsOfOneWithRows) {
  const auto header = [&](const Floats& distances, const std::vector<std::string>& nodes) {
    Table table;
    table.add("distance", std::span<const float>(distances));
    table.add_texts("node", nodes);
    auto file = OutputFile::create(directory_.path("t.npy"));
    EXPECT_TRUE(table.write("t.npy", **file).ok() && (*file)->commit().ok());
    return read_file(directory_.path("t.npy"))->substr(10, 70);
  };
  const std::string description = "{'descr': [('distance', '<f4')], 'fortran_order': False, 'shape': (";
  EXPECT_TRUE(absl::StartsWith(header({}, {}), absl::StrCat(description, "0,"))) << header({}, {});
  EXPECT_TRUE(absl::StartsWith(header({1}, {"ball"}), absl::StrCat(description, "1,"))) << header({1}, {"ball"});
}

TEST_F(PointsTest, ResultsAsText) {
  const std::string path = directory_.path("out.csv");
  auto file = OutputFile::create(path);
  const auto writer = make_result_writer(path, true, **file);
  const Floats xyz = {0.1f, 2, -3}, results = {1.0f / 3, 0, 1e-20f, 16777216};
  EXPECT_TRUE(writer->write(xyz, results).ok());
  EXPECT_TRUE(writer->finish().ok());
  EXPECT_TRUE((*file)->commit().ok());
  EXPECT_EQ(*read_file(path), "x,y,z,value,gx,gy,gz\n0.100000001,2,-3,0.333333343,0,9.99999968e-21,16777216\n");
}

TEST_F(PointsTest, ResultsAsNumpyArray) {
  const std::string path = directory_.path("out.npy");
  auto file = OutputFile::create(path);
  const auto writer = make_result_writer(path, false, **file);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(writer->write(Floats(6), Floats{1, 2}).ok());
  EXPECT_TRUE(writer->finish().ok());
  EXPECT_TRUE((*file)->commit().ok());
  const std::string data = *read_file(path);
  EXPECT_EQ(data.size(), 128u + 40);
  EXPECT_TRUE(absl::StrContains(data, "'shape': (10, 1)"));
}

}  // namespace
}  // namespace isofield
