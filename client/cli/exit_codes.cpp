#include "exit_codes.h"

#include <absl/strings/cord.h>

namespace isofield {
namespace {

// A status keeps its payloads on its way up to main(). They only serve as marks; their contents are empty.
constexpr char kFilePayload[] = "isofield/file";
constexpr char kUsagePayload[] = "isofield/usage";

}  // namespace

absl::Status file_error(absl::Status status) {
  status.SetPayload(kFilePayload, absl::Cord());
  return status;
}

absl::Status usage_error(const std::string& message) {
  absl::Status status = absl::InvalidArgumentError(message);
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

ExitCode exit_code(const absl::Status& status) {
  if (status.ok()) return kSuccess;
  if (status.GetPayload(kUsagePayload).has_value()) return kWrongUsage;
  if (status.GetPayload(kFilePayload).has_value()) return kFileFailed;
  return absl::IsUnavailable(status) ? kNoServer : kRequestFailed;
}

}  // namespace isofield
