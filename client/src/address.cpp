#include "address.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

namespace isofield {
namespace {

// A Unix socket's path must fit sockaddr_un::sun_path with its terminating zero.
constexpr std::size_t kMaxSocketPath = 107;

absl::Status refuse(const std::string& address, const std::string& why) {
  return absl::InvalidArgumentError(
      absl::StrCat("server address \"", address, "\": ", why, "; expected HOST:PORT, [IPV6]:PORT or unix:PATH"));
}

}  // namespace

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
      return refuse(address, absl::StrCat("\"", host, "\" is no host"));
    }
  }
  unsigned port = 0;
  if (port_text.empty() || !absl::ascii_isdigit(port_text.front()) || !absl::SimpleAtoi(port_text, &port) || port < 1 ||
      port > 65535) {
    return refuse(address, absl::StrCat("\"", port_text, "\" is no port within [1, 65535]"));
  }
  return absl::StrCat("dns:///", address);
}

}  // namespace isofield
