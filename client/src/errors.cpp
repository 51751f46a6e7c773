#include "errors.h"

#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <algorithm>

#include "address.h"

namespace isofield {
namespace {

constexpr std::int64_t kLongestPauseMs = 10'000;

}  // namespace

absl::Status from_grpc(const grpc::Status& status, const std::string& address) {
  if (status.ok()) return absl::OkStatus();
  const std::string& detail = status.error_message();
  const auto code = static_cast<absl::StatusCode>(status.error_code());
  switch (code) {
    case absl::StatusCode::kUnavailable:
      if (absl::StrContains(detail, "Socket closed") || absl::StrContains(detail, "reset by peer") ||
          absl::StrContains(detail, "GOAWAY")) {
        return absl::UnavailableError(absl::StrCat("the connection to isofieldd at ", address, " was lost (", detail,
                                                   "); see the daemon's log, then try again"));
      }
      // gRPC does not say that connections to a TCP address are refused.
      if (absl::StrContains(detail, "Connection refused") || absl::StrContains(detail, "No such file or directory") ||
          (absl::StrContains(detail, "failed to connect") && is_refused(address))) {
        return absl::UnavailableError(absl::StrCat("nothing listens at ", address, "; start isofieldd there"));
      }
      return absl::UnavailableError(
          absl::StrCat("no isofieldd answers at ", address, " (", detail, "); is the address right, and is it up?"));
    case absl::StatusCode::kDeadlineExceeded:
      return absl::DeadlineExceededError(
          absl::StrCat("isofieldd at ", address, " did not finish in time (", detail, "); allow it a longer timeout"));
    case absl::StatusCode::kUnimplemented:
      return absl::UnimplementedError(absl::StrCat("the server at ", address, " does not know this request (", detail,
                                                   "); is it an isofieldd of this version?"));
    case absl::StatusCode::kResourceExhausted:
      if (absl::StrContains(detail, "message larger than max")) {
        return absl::ResourceExhaustedError(
            absl::StrCat("the request does not fit one message (", detail, "); \"isofield info\" shows the limits"));
      }
      break;
    default:
      break;
  }
  return absl::Status(code,
                      detail.empty() ? absl::StrCat("isofieldd at ", address, " failed without a message") : detail);
}

std::optional<std::chrono::milliseconds> retry_after(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerTrailingMetadata();
  const auto hint = metadata.find("grpc-retry-pushback-ms");
  std::int64_t ms = -1;
  if (hint == metadata.end() || !absl::SimpleAtoi(absl::string_view(hint->second.data(), hint->second.size()), &ms) ||
      ms < 0) {
    return std::nullopt;
  }
  return std::chrono::milliseconds(std::min(ms, kLongestPauseMs));
}

}  // namespace isofield
