#include "shared_memory.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "isofield/v1/shared_memory.pb.h"

namespace isofield {
namespace {

constexpr char kVersion = 1;
constexpr std::size_t kMostKept = 4;

absl::Status unavailable(const std::string& what, absl::string_view why) {
  return absl::UnavailableError(absl::StrCat("shared memory: ", what, ": ", why));
}

absl::Status system_error(const std::string& what) {
  return unavailable(what, std::strerror(errno));
}

int connect_to(const std::string& path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.size() >= sizeof(name.sun_path)) {
    errno = ENAMETOOLONG;
    return -1;
  }
  std::memcpy(name.sun_path, path.data(), path.size());
  const int descriptor = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (descriptor < 0 || connect(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0) {
    return descriptor;
  }
  const int error = errno;
  close(descriptor);
  errno = error;
  return -1;
}

// Sends one packet: the version of the protocol, with a descriptor.
bool send_descriptor(int socket, int descriptor) {
  char version = kVersion;
  iovec data{&version, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* const head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(head), &descriptor, sizeof(int));
  return sendmsg(socket, &message, MSG_NOSIGNAL) == 1;
}

}  // namespace

absl::StatusOr<std::unique_ptr<SharedMemory>> SharedMemory::open(const std::string& socket_path, std::size_t bytes) {
  std::unique_ptr<SharedMemory> memory(new SharedMemory);
  memory->socket_ = connect_to(socket_path);
  if (memory->socket_ < 0) return system_error(socket_path);
  const int descriptor = memfd_create("isofield", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor < 0) return system_error("memfd_create");
  void* data = MAP_FAILED;
  bool is_sent = false;
  if (ftruncate(descriptor, static_cast<off_t>(bytes)) == 0 &&
      fcntl(descriptor, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) == 0) {
    data = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    is_sent = data != MAP_FAILED && send_descriptor(memory->socket_, descriptor);
  }
  const int error = errno;
  close(descriptor);
  if (data != MAP_FAILED) {
    memory->data_ = static_cast<std::byte*>(data);
    memory->bytes_ = bytes;
  }
  errno = error;
  if (!is_sent) return system_error(absl::StrCat("a region of ", bytes, " bytes"));
  std::array<char, 4096> answer;
  const ssize_t got = recv(memory->socket_, answer.data(), answer.size(), 0);
  if (got < 0) return system_error(socket_path);
  if (got == 0) return unavailable(socket_path, "the daemon closed the connection without an answer");
  v1::OpenRegionResponse response;
  if (!response.ParseFromArray(answer.data(), static_cast<int>(got))) {
    return unavailable(socket_path, "the answer is no OpenRegionResponse");
  }
  if (response.region().empty()) {
    if (response.code() == 0) return unavailable(socket_path, "the answer has neither a region nor an error");
    return absl::Status(static_cast<absl::StatusCode>(response.code()), response.message());
  }
  memory->region_ = response.region();
  return memory;
}

SharedMemory::~SharedMemory() {
  if (data_) munmap(data_, bytes_);
  if (socket_ >= 0) close(socket_);
}

bool SharedMemory::is_alive() const {
  char byte = 0;
  return recv(socket_, &byte, 1, MSG_DONTWAIT | MSG_PEEK) < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
}

std::unique_ptr<SharedMemory> SharedMemoryPool::take() {
  const std::lock_guard lock(mutex_);
  while (!kept_.empty()) {
    std::unique_ptr<SharedMemory> memory = std::move(kept_.back());
    kept_.pop_back();
    if (memory->is_alive()) return memory;
  }
  return nullptr;
}

void SharedMemoryPool::give(std::unique_ptr<SharedMemory> memory) {
  const std::lock_guard lock(mutex_);
  if (kept_.size() < kMostKept) kept_.push_back(std::move(memory));
}

}  // namespace isofield
