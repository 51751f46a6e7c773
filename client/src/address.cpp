#include "address.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

namespace isofield {
namespace {

// A Unix socket's path must fit sockaddr_un::sun_path with its terminating zero.
constexpr std::size_t kMaxSocketPath = 107;

absl::Status refuse(const std::string& address, const std::string& why) {
  return absl::InvalidArgumentError(
      absl::StrCat("server address \"", address, "\": ", why, "; expected HOST:PORT, [IPV6]:PORT or unix:PATH"));
}

// Tries to connect. Returns the error of the attempt, or 0 where it connects or where nothing is known within the time.
int connection_error(const addrinfo& to) {
  constexpr int kMilliseconds = 500;
  const int socket = ::socket(to.ai_family, to.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, to.ai_protocol);
  if (socket < 0) return 0;
  int error = ::connect(socket, to.ai_addr, to.ai_addrlen) == 0 ? 0 : errno;
  if (error == EINPROGRESS) {
    pollfd wait{socket, POLLOUT, 0};
    socklen_t size = sizeof(error);
    const bool has_ended = ::poll(&wait, 1, kMilliseconds) > 0;
    if (!has_ended || ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = 0;
  }
  ::close(socket);
  return error;
}

}  // namespace

bool is_refused(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || absl::StartsWith(address, "unix:")) return false;
  std::string host = address.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), address.c_str() + colon + 1, &hints, &found) != 0) return false;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(found, &::freeaddrinfo);
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    if (connection_error(*at) != ECONNREFUSED) return false;
  }
  return true;
}

absl::StatusOr<std::string> grpc_target(const std::string& address) {
  if (absl::StartsWith(address, "unix:")) {
    const std::string path = address.substr(5);
    if (path.empty()) return refuse(address, "the socket's path is empty");
    if (path.size() > kMaxSocketPath) {
      return refuse(address, absl::StrCat("the socket's path is longer than ", kMaxSocketPath, " bytes"));
    }
    return address;
  }
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos) return refuse(address, "no port is stated");
  const std::string host = address.substr(0, colon);
  const std::string port_text = address.substr(colon + 1);
  if (host.empty()) return refuse(address, "no host is stated");
  const bool bracketed = host.front() == '[' && host.back() == ']' && host.size() > 2;
  for (const char c : host) {
    if (absl::ascii_isspace(c) || c == '/' || (c == ':' && !bracketed)) {
      return refuse(address, absl::StrCat("\"", host, "\" is not a host"));
    }
  }
  unsigned port = 0;
  if (port_text.empty() || !absl::ascii_isdigit(port_text.front()) || !absl::SimpleAtoi(port_text, &port) || port < 1 ||
      port > 65535) {
    return refuse(address, absl::StrCat("\"", port_text, "\" is not a port within [1, 65535]"));
  }
  return absl::StrCat("dns:///", address);
}

}  // namespace isofield
