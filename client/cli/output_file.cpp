#include "output_file.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>

namespace isofield {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

// The name of the file that the signal handler removes. It is a global array because a signal handler may only read
// memory that always exists.
char pending_path[PATH_MAX];
volatile sig_atomic_t is_pending = 0;

void remove_and_die(int signal_number) {
  if (is_pending) ::unlink(pending_path);
  // SA_RESETHAND has restored the default action, so the parent process sees that this signal ended the program.
  ::raise(signal_number);
}

void remove_and_end(int) {
  if (is_pending) ::unlink(pending_path);
  ::_exit(0);
}

absl::Status write_error(const std::string& path) {
  return absl::ErrnoToStatus(errno, absl::StrCat("cannot write ", path));
}

}  // namespace

void remove_output_when_interrupted() {
  struct sigaction action {};
  action.sa_handler = remove_and_die;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal_number, &action, nullptr);
}

void end_well_when_interrupted() {
  struct sigaction action {};
  action.sa_handler = remove_and_end;
  for (const int signal_number : {SIGINT, SIGTERM}) ::sigaction(signal_number, &action, nullptr);
}

absl::StatusOr<std::unique_ptr<OutputFile>> OutputFile::create(const std::string& path) {
  if (path == "-") return std::unique_ptr<OutputFile>(new OutputFile("the standard output", "", STDOUT_FILENO));
  struct stat information {};
  if (::stat(path.c_str(), &information) == 0 && !S_ISREG(information.st_mode)) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return write_error(path);
    return std::unique_ptr<OutputFile>(new OutputFile(path, "", descriptor));
  }
  std::string temporary = path + ".XXXXXX";
  // The signal handler must know the name before the file exists, so mkostemp() writes it into the handler's array.
  const bool is_short = temporary.size() < sizeof(pending_path);
  if (is_short) std::memcpy(pending_path, temporary.c_str(), temporary.size() + 1);
  char* const name = is_short ? pending_path : temporary.data();
  is_pending = is_short ? 1 : 0;
  const int descriptor = ::mkostemp(name, O_CLOEXEC);
  if (descriptor < 0) {
    is_pending = 0;
    return write_error(path);
  }
  if (is_short) temporary = pending_path;
  // mkostemp() lets only the owner use the file. It gets the permissions that the umask allows to any new file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  return std::unique_ptr<OutputFile>(new OutputFile(path, temporary, descriptor));
}

absl::Status OutputFile::check(const std::string& path) {
  struct stat information {};
  if (path == "-") return absl::OkStatus();
  if (::stat(path.c_str(), &information) == 0 && !S_ISREG(information.st_mode)) {
    if (S_ISDIR(information.st_mode)) errno = EISDIR;
    return !S_ISDIR(information.st_mode) && ::access(path.c_str(), W_OK) == 0 ? absl::OkStatus() : write_error(path);
  }
  const std::size_t slash = path.rfind('/');
  const std::string directory = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  return ::access(directory.c_str(), W_OK | X_OK) == 0 ? absl::OkStatus() : write_error(path);
}

OutputFile::OutputFile(std::string path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {
  buffer_.reserve(kBufferBytes);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (descriptor_ != STDOUT_FILENO) ::close(descriptor_);
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    is_pending = 0;
  }
}

absl::Status OutputFile::write(const void* data, std::size_t bytes) {
  if (buffer_.size() + bytes > kBufferBytes) {
    if (auto status = flush(); !status.ok()) return status;
  }
  const char* begin = static_cast<const char*>(data);
  if (bytes >= kBufferBytes) return write_through(begin, bytes);
  buffer_.insert(buffer_.end(), begin, begin + bytes);
  return absl::OkStatus();
}

absl::Status OutputFile::rewrite(std::uint64_t offset, const void* data, std::size_t bytes) {
  if (temporary_.empty()) return absl::FailedPreconditionError(absl::StrCat(path_, " is not a regular file"));
  if (auto status = flush(); !status.ok()) return status;
  if (::pwrite(descriptor_, data, bytes, static_cast<off_t>(offset)) != static_cast<ssize_t>(bytes)) {
    return write_error(path_);
  }
  return absl::OkStatus();
}

absl::Status OutputFile::commit() {
  if (auto status = flush(); !status.ok()) return status;
  const int descriptor = descriptor_;
  if (descriptor == STDOUT_FILENO) return absl::OkStatus();
  descriptor_ = -1;
  if (::close(descriptor) != 0 || (!temporary_.empty() && ::rename(temporary_.c_str(), path_.c_str()) != 0)) {
    const absl::Status status = write_error(path_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    is_pending = 0;
    return status;
  }
  is_pending = 0;
  return absl::OkStatus();
}

absl::Status OutputFile::flush() {
  auto status = write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
  return status;
}

absl::Status OutputFile::write_through(const char* data, std::size_t bytes) {
  flushed_ += bytes;
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, data, bytes);
    if (written < 0) {
      if (errno == EINTR) continue;
      return write_error(path_);
    }
    data += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return absl::OkStatus();
}

}  // namespace isofield
