#include "daemon/region_socket.h"

#include <absl/strings/str_cat.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "daemon/socket.h"
#include "isofield/v1/shared_memory.pb.h"

namespace isofield::daemon {
namespace {

constexpr char kVersion = 1;

// A packet may bring up to this many descriptors. One is expected; all are closed after the packet is answered.
constexpr std::size_t kMostDescriptors = 4;

// The result of one read from a connection. It has no bytes if there is nothing to read yet.
struct Packet {
  bool is_over = false;  // the client has closed the connection, or it has failed
  std::string bytes;
  std::vector<Descriptor> descriptors;
};

Packet receive(int socket) {
  char bytes[16];
  iovec data{bytes, sizeof(bytes)};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> control;
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t got = recvmsg(socket, &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  Packet packet;
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return packet;
  if (got <= 0) {
    packet.is_over = true;
    return packet;
  }
  packet.bytes.assign(bytes, static_cast<std::size_t>(got));
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_RIGHTS) continue;
    for (std::size_t at = CMSG_LEN(0); at + sizeof(int) <= c->cmsg_len; at += sizeof(int)) {
      int number = -1;
      std::memcpy(&number, reinterpret_cast<const char*>(c) + at, sizeof(int));
      packet.descriptors.emplace_back(number);
    }
  }
  return packet;
}

bool answer(int socket, const absl::StatusOr<std::string>& region) {
  v1::OpenRegionResponse response;
  if (region.ok()) {
    response.set_region(*region);
  } else {
    response.set_code(static_cast<int>(region.status().code()));
    response.set_message(std::string(region.status().message()));
  }
  const std::string bytes = response.SerializeAsString();
  return send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(bytes.size());
}

bool is_same_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  return getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == geteuid();
}

absl::Status cannot_listen(const std::string& path) {
  return absl::UnavailableError(absl::StrCat("--shared-memory: cannot listen on ", path, ": ", std::strerror(errno)));
}

}  // namespace

std::string region_socket_path(const Config& config) {
  const std::string path = config.shared_memory ? unix_path(config.listen) : "";
  return path.empty() ? "" : std::filesystem::absolute(path).string() + ".shm";
}

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

absl::StatusOr<std::unique_ptr<RegionSocket>> RegionSocket::listen(const std::string& path, rpc::SharedRegions& regions,
                                                                   std::size_t max_connections) {
  sockaddr_un name{};
  if (path.size() >= sizeof(name.sun_path)) {
    return absl::InvalidArgumentError(absl::StrCat("--shared-memory: the socket ", path, " has a path of more than ",
                                                   sizeof(name.sun_path) - 1, " characters"));
  }
  name.sun_family = AF_UNIX;
  std::memcpy(name.sun_path, path.data(), path.size());
  struct stat there {};
  if (lstat(path.c_str(), &there) == 0 && S_ISSOCK(there.st_mode)) unlink(path.c_str());
  Descriptor listener(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  Descriptor stop(eventfd(0, EFD_CLOEXEC));
  if (!listener || !stop || bind(listener.get(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0) {
    return cannot_listen(path);
  }
  if (chmod(path.c_str(), S_IRUSR | S_IWUSR) != 0 || ::listen(listener.get(), SOMAXCONN) != 0) {
    return cannot_listen(path);
  }
  return std::unique_ptr<RegionSocket>(
      new RegionSocket(path, regions, max_connections, std::move(listener), std::move(stop)));
}

RegionSocket::~RegionSocket() {
  eventfd_write(stop_.get(), 1);
  thread_.join();
  for (const Connection& c : connections_) regions_.close(c.region);
  unlink(path_.c_str());
}

void RegionSocket::serve() {
  std::vector<pollfd> waits;
  while (true) {
    // Each connection may own one region. While as many are open as are admitted, further clients wait in the
    // listener's queue.
    const short accepts = connections_.size() < max_connections_ ? POLLIN : 0;
    waits = {{stop_.get(), POLLIN, 0}, {listener_.get(), accepts, 0}};
    for (const Connection& c : connections_) waits.push_back({c.socket.get(), POLLIN, 0});
    if (poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) {
      spdlog::error("shared memory: waiting for clients: {}", std::strerror(errno));
      return;
    }
    if (waits[0].revents) return;
    for (std::size_t i = connections_.size(); i-- > 0;) {
      if (!waits[2 + i].revents || read_one(connections_[i])) continue;
      regions_.close(connections_[i].region);
      connections_.erase(connections_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (waits[1].revents) accept_one();
  }
}

void RegionSocket::accept_one() {
  Descriptor socket(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket) return;
  if (!is_same_user(socket.get())) {
    answer(socket.get(), absl::PermissionDeniedError("the daemon shares memory with its own user's processes alone"));
    return;
  }
  connections_.push_back({std::move(socket), ""});
}

bool RegionSocket::read_one(Connection& connection) {
  Packet packet = receive(connection.socket.get());
  if (packet.is_over) return false;
  if (packet.bytes.empty()) return true;
  absl::StatusOr<std::string> region;
  if (!connection.region.empty()) {
    region = absl::FailedPreconditionError("this connection has a region: open another one");
  } else if (packet.bytes != std::string(1, kVersion) || packet.descriptors.size() != 1) {
    region = absl::InvalidArgumentError("expected a packet of the byte 1, with one descriptor");
  } else {
    region = regions_.open(packet.descriptors.front().get());
    if (region.ok()) connection.region = *region;
  }
  packet.descriptors.clear();  // closed before the answer, so that an answered client finds none of them open here
  return answer(connection.socket.get(), region) && region.ok();
}

}  // namespace isofield::daemon
