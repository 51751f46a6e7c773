// Which of a machine's devices to use: a pure function, testable without one.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isofield::gpu {

struct DeviceCandidate {
  enum class Type { kDiscrete, kIntegrated, kVirtual, kCpu, kOther };

  std::string name;
  Type type = Type::kOther;
  std::uint32_t api_major = 1, api_minor = 0;
  bool has_compute_queue = false;
  std::uint32_t storage_buffers_per_stage = 0;
  std::uint32_t uniform_bytes = 0;
  std::uint32_t workgroup_invocations = 0;
  // Votes and shuffles of subgroups in compute shaders.
  bool has_subgroup_operations = false;
};

// The place of the best candidate: one whose name holds `wanted` (any case), or, where that is empty, discrete before
// integrated before virtual before CPU; the first among equals. NOT_FOUND: none will do, with the reason for each.
absl::StatusOr<std::size_t> select_device(const std::vector<DeviceCandidate>& candidates, const std::string& wanted);

}  // namespace isofield::gpu
