#include "gpu/device_selection.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

namespace isofield::gpu {
namespace {

constexpr std::uint32_t kStorageBuffers = 16;
constexpr std::uint32_t kUniformBytes = 65'536;
constexpr std::uint32_t kInvocations = 64;

// Returns why a candidate cannot be used, or "" if it can.
std::string unfit_because(const DeviceCandidate& c, const std::string& wanted) {
  if (c.api_major < 1 || (c.api_major == 1 && c.api_minor < 1)) {
    return absl::StrCat("has Vulkan ", c.api_major, ".", c.api_minor, ", 1.1 is needed");
  }
  if (!c.has_compute_queue) return "has no compute queue";
  if (c.storage_buffers_per_stage < kStorageBuffers) {
    return absl::StrCat("binds ", c.storage_buffers_per_stage, " storage buffers, ", kStorageBuffers, " are needed");
  }
  if (c.uniform_bytes < kUniformBytes) {
    return absl::StrCat("binds ", c.uniform_bytes, " bytes of a uniform buffer, ", kUniformBytes, " are needed");
  }
  if (c.workgroup_invocations < kInvocations) {
    return absl::StrCat("runs ", c.workgroup_invocations, " invocations a workgroup, ", kInvocations, " are needed");
  }
  if (!c.has_subgroup_operations) return "has no votes and shuffles within subgroups of compute shaders";
  if (!wanted.empty() && !absl::StrContains(absl::AsciiStrToLower(c.name), absl::AsciiStrToLower(wanted))) {
    return absl::StrCat("is not named '", wanted, "'");
  }
  return "";
}

}  // namespace

absl::StatusOr<std::size_t> select_device(const std::vector<DeviceCandidate>& candidates, const std::string& wanted) {
  std::size_t best = candidates.size();
  std::string reasons;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::string reason = unfit_because(candidates[i], wanted);
    if (!reason.empty()) {
      absl::StrAppend(&reasons, reasons.empty() ? "" : "; ", "'", candidates[i].name, "' ", reason);
    } else if (best == candidates.size() || candidates[i].type < candidates[best].type) {
      best = i;
    }
  }
  if (best < candidates.size()) return best;
  if (candidates.empty()) {
    return absl::NotFoundError("no Vulkan device; install a driver, for example Debian's mesa-vulkan-drivers");
  }
  return absl::NotFoundError(absl::StrCat("no usable Vulkan device: ", reasons));
}

}  // namespace isofield::gpu
