#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isofield {

// Tells when a file has changed: it was written and closed, or another one was put in its place, as editors do. The
// folder is watched, so the file may vanish for a while. Of a symbolic link the file that it leads to counts as well.
//
// Linux only (inotify); single-threaded.
class FileWatch {
 public:
  // Changes count from here on. Errors name the path: its folder must be there.
  static absl::StatusOr<std::unique_ptr<FileWatch>> create(const std::string& path);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  // Blocks until the file has changed since the last call, or since create(). Changes that come together count once.
  // NOT_FOUND: its folder is gone.
  absl::Status wait();

 private:
  FileWatch(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  // Watches the folders of the path and of what it leads to at present.
  absl::Status follow();
  absl::Status watch(const std::string& path);
  // Takes the events that have come, waiting for some if `blocks`; whether one is the file's.
  absl::StatusOr<bool> take_events(bool blocks);

  const std::string path_;
  const int descriptor_;
  std::vector<std::pair<int, std::string>> names_;  // by watched folder
};

}  // namespace isofield
