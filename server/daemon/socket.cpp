#include "daemon/socket.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/strip.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace isofield::daemon {
namespace {

absl::Status check_host_and_port(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  std::uint32_t number = 0;
  const bool is_port = !port.empty() && std::all_of(port.begin(), port.end(), absl::ascii_isdigit) &&
                       absl::SimpleAtoi(port, &number) && number <= 65535;
  if (colon == 0 || !is_port) {
    return absl::InvalidArgumentError(
        absl::StrCat("--listen ", address, ": expected HOST:PORT with a port within [0, 65535], or unix:PATH"));
  }
  return absl::OkStatus();
}

}  // namespace

std::string unix_path(const std::string& address) {
  if (!absl::StartsWith(address, "unix:")) return "";
  std::string path(absl::StripPrefix(address, "unix:"));
  return absl::StartsWith(path, "//") ? path.substr(2) : path;
}

absl::Status check_listen_address(const std::string& address) {
  if (!absl::StartsWith(address, "unix:")) return check_host_and_port(address);
  const std::string path = unix_path(address);
  sockaddr_un name{};
  if (path.empty() || path.size() >= sizeof(name.sun_path)) {
    return absl::InvalidArgumentError(
        absl::StrCat("--listen ", address, ": expected a path of 1 to ", sizeof(name.sun_path) - 1, " characters"));
  }
  name.sun_family = AF_UNIX;
  std::memcpy(name.sun_path, path.data(), path.size());
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return absl::OkStatus();  // gRPC will fail, too, and will say why
  const bool serves = connect(fd, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0;
  close(fd);
  if (serves) return absl::AlreadyExistsError(absl::StrCat("another process serves on ", address));
  return absl::OkStatus();
}

}  // namespace isofield::daemon
