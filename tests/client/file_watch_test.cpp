#include "file_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <future>

#include "test_support.h"

namespace isofield {
namespace {

// Owns a watch on the file "scene" in a directory of its own, and changes the file. wait() returns at once if a change
// comes before it, so no thread is needed. A test that fails hangs until its time limit.
class FileWatchTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.path(name); }
  void start(const std::string& name) { watch_ = *FileWatch::create(path(name)); }

  TemporaryDirectory directory_;
  std::unique_ptr<FileWatch> watch_;
};

TEST_F(FileWatchTest, SeesAFileThatIsWritten) {
  write_file(path("scene"), "1");
  start("scene");
  write_file(path("scene"), "2");
  EXPECT_TRUE(watch_->wait().ok());
  write_file(path("scene"), "3");
  EXPECT_TRUE(watch_->wait().ok());
}

TEST_F(FileWatchTest, SeesAFileThatIsReplacedAsEditorsDo) {
  write_file(path("scene"), "1");
  start("scene");
  for (int i = 0; i < 3; ++i) {
    write_file(path("scene~"), "2");
    ASSERT_EQ(std::rename(path("scene~").c_str(), path("scene").c_str()), 0);
    EXPECT_TRUE(watch_->wait().ok());
  }
  ASSERT_EQ(::unlink(path("scene").c_str()), 0);
  write_file(path("scene"), "3");
  EXPECT_TRUE(watch_->wait().ok());
}

TEST_F(FileWatchTest, FollowsLinks) {
  std::filesystem::create_directory(path("elsewhere"));
  write_file(path("elsewhere/real"), "1");
  write_file(path("elsewhere/other"), "1");
  std::filesystem::create_symlink("elsewhere/real", path("scene"));
  start("scene");
  write_file(path("elsewhere/real"), "2");
  EXPECT_TRUE(watch_->wait().ok()) << "what it leads to is written";
  std::filesystem::remove(path("scene"));
  std::filesystem::create_symlink("elsewhere/other", path("scene"));
  EXPECT_TRUE(watch_->wait().ok()) << "it leads elsewhere";
  auto waited = std::async(std::launch::async, [&] { return watch_->wait(); });
  // The change counts whether it comes while wait() blocks or just before.
  write_file(path("elsewhere/other"), "2");
  EXPECT_TRUE(waited.get().ok());
}

TEST_F(FileWatchTest, OtherFilesDoNotCount) {
  std::filesystem::create_directory(path("folder"));
  write_file(path("folder/scene"), "1");
  start("folder/scene");
  write_file(path("folder/scene2"), "1");
  write_file(path("folder/picture.png"), "1");
  std::filesystem::remove_all(path("folder"));
  EXPECT_EQ(watch_->wait().code(), absl::StatusCode::kNotFound) << "the first thing that counts is the folder's end";
}

TEST_F(FileWatchTest, AFolderThatIsGoneEndsIt) {
  std::filesystem::create_directory(path("folder"));
  write_file(path("folder/scene"), "1");
  start("folder/scene");
  std::filesystem::remove_all(path("folder"));
  EXPECT_EQ(watch_->wait().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(FileWatch::create(path("folder/scene")).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace isofield
