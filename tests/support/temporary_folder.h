// Makes folders for tests and removes them afterwards.
#pragma once

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace isofield::test_support {

// An empty folder that no other process uses. It is removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::path(testing::TempDir()) / absl::StrCat("isofield_", getpid(), "_", next_++)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }

 private:
  static inline int next_ = 0;
  const std::filesystem::path path_;
};

}  // namespace isofield::test_support
