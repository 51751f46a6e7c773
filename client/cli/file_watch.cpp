#include "file_watch.h"

#include <absl/strings/str_cat.h>
#include <limits.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace isofield {
namespace {

absl::Status watch_error(const std::string& path) {
  return absl::ErrnoToStatus(errno, absl::StrCat("cannot watch ", path));
}

}  // namespace

absl::StatusOr<std::unique_ptr<FileWatch>> FileWatch::create(const std::string& path) {
  const int descriptor = ::inotify_init1(IN_CLOEXEC);
  if (descriptor < 0) return watch_error(path);
  std::unique_ptr<FileWatch> watch(new FileWatch(path, descriptor));
  if (auto status = watch->follow(); !status.ok()) return status;
  return watch;
}

FileWatch::~FileWatch() {
  ::close(descriptor_);
}

absl::Status FileWatch::watch(const std::string& path) {
  const std::filesystem::path file(path);
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  // A folder that is watched already keeps its number. IN_CREATE counts for links only: a file that has just been
  // created is not complete before it is closed.
  const int number =
      ::inotify_add_watch(descriptor_, folder.c_str(),
                          IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
  if (number < 0) return watch_error(path);
  names_.emplace_back(number, file.filename().string());
  return absl::OkStatus();
}

absl::Status FileWatch::follow() {
  names_.clear();
  if (auto status = watch(path_); !status.ok()) return status;
  std::error_code failure;
  const auto target = std::filesystem::canonical(path_, failure);
  // A link that leads nowhere is watched itself; it may lead to a file later.
  return failure || !std::filesystem::is_symlink(path_, failure) ? absl::OkStatus() : watch(target.string());
}

absl::StatusOr<bool> FileWatch::take_events(bool blocks) {
  pollfd waiting{descriptor_, POLLIN, 0};
  int ready = 0;
  do {
    ready = ::poll(&waiting, 1, blocks ? -1 : 0);
  } while (ready < 0 && errno == EINTR);
  if (ready < 0) return watch_error(path_);
  if (ready == 0) return false;
  alignas(inotify_event) char buffer[64 * (sizeof(inotify_event) + NAME_MAX + 1)];
  const ssize_t bytes = ::read(descriptor_, buffer, sizeof(buffer));
  if (bytes < 0) return errno == EINTR ? absl::StatusOr<bool>(false) : watch_error(path_);
  bool changed = false;
  for (ssize_t at = 0; at < bytes;) {
    inotify_event event;
    std::memcpy(&event, buffer + at, sizeof(event));
    const std::string name = event.len > 0 ? std::string(buffer + at + sizeof(event)) : "";
    at += static_cast<ssize_t>(sizeof(event) + event.len);
    if (event.mask & IN_Q_OVERFLOW) changed = true;
    if (event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_UNMOUNT) && event.wd == names_.front().first) {
      return absl::NotFoundError(absl::StrCat(path_, ": its folder is gone"));
    }
    if (std::find(names_.begin(), names_.end(), std::pair(event.wd, name)) == names_.end()) continue;
    std::error_code ignored;
    if (!(event.mask & IN_CREATE) || std::filesystem::is_symlink(path_, ignored)) changed = true;
  }
  return changed;
}

absl::Status FileWatch::wait() {
  absl::StatusOr<bool> changed = false;
  while (changed.ok() && !*changed) changed = take_events(true);
  // Events that are there already belong to the same change.
  for (absl::StatusOr<bool> more = changed; more.ok() && *more;) more = take_events(false);
  if (!changed.ok()) return changed.status();
  // The target of a link is looked up before the caller reads the file, so that no change of it is missed.
  return follow();
}

}  // namespace isofield
