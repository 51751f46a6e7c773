// Chooses which of a machine's Vulkan devices to use. It is a pure function of what drivers state, so that it can be
// tested without a device.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isofield::gpu {

// The properties of a device on which the choice depends.
struct DeviceCandidate {
  enum class Type { kDiscrete, kIntegrated, kVirtual, kCpu, kOther };

  std::string name;
  Type type = Type::kOther;
  std::uint32_t api_major = 1, api_minor = 0;
  bool has_compute_queue = false;
  std::uint32_t storage_buffers_per_stage = 0;
  std::uint32_t uniform_bytes = 0;
  std::uint32_t workgroup_invocations = 0;
  // Compute shaders can use votes and shuffles within subgroups.
  bool has_subgroup_operations = false;
};

// Returns the index of the best usable candidate whose name contains `wanted`, in upper or lower case; every name does
// if `wanted` is empty. The order is discrete, integrated, virtual, CPU, other; among equals the first is taken.
// NOT_FOUND: none is usable; the message gives the reason for each.
absl::StatusOr<std::size_t> select_device(const std::vector<DeviceCandidate>& candidates, const std::string& wanted);

}  // namespace isofield::gpu
