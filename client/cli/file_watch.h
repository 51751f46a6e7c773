#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isofield {

// Tells when a file has changed: somebody has written and closed it, or put another one in its place, as editors do.
// The folder is watched, so the file may vanish for a while. For a symbolic link, changes of its target count as well.
//
// It owns an inotify descriptor, so it works on Linux only. It is single-threaded.
class FileWatch {
 public:
  // Changes count from this call on. The folder of the file must exist. Errors name the path.
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
  // Reads the events that have come, and waits for some if `blocks` is true. Returns true if one is about the file.
  absl::StatusOr<bool> take_events(bool blocks);

  const std::string path_;
  const int descriptor_;
  std::vector<std::pair<int, std::string>> names_;  // the number of a watched folder, and the name of a file in it
};

}  // namespace isofield
