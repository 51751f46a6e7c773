#include "output_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "isofield/scene_file.h"
#include "test_support.h"

namespace isofield {
namespace {

TEST(OutputFile, AppearsOnCommitOnly) {
  const TemporaryDirectory directory;
  const std::string path = write_file(directory.path("a"), "old");
  {
    auto file = OutputFile::create(path);
    ASSERT_TRUE(file.ok()) << file.status();
    EXPECT_TRUE((*file)->write("half").ok());
    EXPECT_EQ(*read_file(path), "old");
  }
  EXPECT_EQ(*read_file(path), "old");
  EXPECT_EQ(directory.file_count(), 1u);
  auto file = OutputFile::create(path);
  const std::string large(3 << 20, 'x');
  EXPECT_TRUE((*file)->write("new ").ok());
  EXPECT_TRUE((*file)->write(large).ok());
  EXPECT_TRUE((*file)->rewrite(0, "N", 1).ok());
  EXPECT_EQ((*file)->bytes(), large.size() + 4);
  EXPECT_TRUE((*file)->commit().ok());
  EXPECT_EQ(*read_file(path), "New " + large);
  EXPECT_EQ(directory.file_count(), 1u);
}

TEST(OutputFile, PlacesAreCheckedBeforehand) {
  const TemporaryDirectory directory;
  for (const std::string& good :
       {directory.path("new"), std::string("-"), std::string("/dev/null"), std::string("here")}) {
    EXPECT_TRUE(OutputFile::check(good).ok()) << good << OutputFile::check(good);
  }
  EXPECT_EQ(directory.file_count(), 0u);
  EXPECT_EQ(OutputFile::check(directory.path("no/such/directory")).code(), absl::StatusCode::kNotFound);
  EXPECT_FALSE(OutputFile::check(directory.path("")).ok()) << "a directory itself";
}

TEST(OutputFile, UnwritablePlacesAreErrors) {
  const TemporaryDirectory directory;
  const auto file = OutputFile::create(directory.path("no/such/directory"));
  EXPECT_EQ(file.status().code(), absl::StatusCode::kNotFound);
  EXPECT_FALSE(OutputFile::create(directory.path("")).ok());
  auto full = OutputFile::create("/dev/full");
  ASSERT_TRUE(full.ok()) << full.status();
  EXPECT_TRUE((*full)->write("x").ok());
  EXPECT_EQ((*full)->commit().code(), absl::StatusCode::kResourceExhausted);
}

}  // namespace
}  // namespace isofield
