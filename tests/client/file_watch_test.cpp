#include "file_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include "test_support.h"

namespace isofield {
namespace {

// Owns a watch on the file "scene" in a directory of its own, and changes the file.
class FileWatchTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.path(name); }
  void start(const std::string& name) { watch_ = *FileWatch::create(path(name)); }

  // Waits for a change on a thread of its own. Nothing can end a wait for a change that is not seen, so its thread is
  // left behind then, and keeps the watch.
  std::future<absl::Status> begin_wait() const {
    std::promise<absl::Status> ended;
    auto result = ended.get_future();
    std::thread([watch = watch_, ended = std::move(ended)]() mutable { ended.set_value(watch->wait()); }).detach();
    return result;
  }
  static absl::Status end_of(std::future<absl::Status> wait) {
    if (wait.wait_for(std::chrono::minutes(2)) == std::future_status::ready) return wait.get();
    return absl::DeadlineExceededError("no change is seen within two minutes");
  }
  absl::Status wait() const { return end_of(begin_wait()); }

  TemporaryDirectory directory_;
  std::shared_ptr<FileWatch> watch_;
};

TEST_F(FileWatchTest, SeesAFileThatIsWritten) {
  write_file(path("scene"), "1");
  start("scene");
  write_file(path("scene"), "2");
  EXPECT_EQ(wait(), absl::OkStatus());
  write_file(path("scene"), "3");
  EXPECT_EQ(wait(), absl::OkStatus());
}

TEST_F(FileWatchTest, SeesAFileThatIsReplacedAsEditorsDo) {
  write_file(path("scene"), "1");
  start("scene");
  for (int i = 0; i < 3; ++i) {
    write_file(path("scene~"), "2");
    ASSERT_EQ(std::rename(path("scene~").c_str(), path("scene").c_str()), 0);
    EXPECT_EQ(wait(), absl::OkStatus());
  }
  ASSERT_EQ(::unlink(path("scene").c_str()), 0);
  write_file(path("scene"), "3");
  EXPECT_EQ(wait(), absl::OkStatus());
}

TEST_F(FileWatchTest, FollowsLinks) {
  std::filesystem::create_directory(path("elsewhere"));
  write_file(path("elsewhere/real"), "1");
  write_file(path("elsewhere/other"), "1");
  std::filesystem::create_symlink("elsewhere/real", path("scene"));
  start("scene");
  write_file(path("elsewhere/real"), "2");
  EXPECT_EQ(wait(), absl::OkStatus()) << "what it leads to is written";
  std::filesystem::remove(path("scene"));
  std::filesystem::create_symlink("elsewhere/other", path("scene"));
  EXPECT_EQ(wait(), absl::OkStatus()) << "it leads elsewhere";
  auto waited = begin_wait();
  // The change counts whether it comes while wait() blocks or just before.
  write_file(path("elsewhere/other"), "2");
  EXPECT_EQ(end_of(std::move(waited)), absl::OkStatus());
}

TEST_F(FileWatchTest, OtherFilesDoNotCount) {
  std::filesystem::create_directory(path("folder"));
  write_file(path("folder/scene"), "1");
  start("folder/scene");
  write_file(path("folder/scene2"), "1");
  write_file(path("folder/picture.png"), "1");
  std::filesystem::remove_all(path("folder"));
  EXPECT_EQ(wait().code(), absl::StatusCode::kNotFound) << "the first thing that counts is the folder's end";
}

TEST_F(FileWatchTest, AFolderThatIsGoneEndsIt) {
  std::filesystem::create_directory(path("folder"));
  write_file(path("folder/scene"), "1");
  start("folder/scene");
  std::filesystem::remove_all(path("folder"));
  EXPECT_EQ(wait().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(FileWatch::create(path("folder/scene")).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace isofield
