// Specialises a kernel to the constants of a scene's tapes before the driver compiles it, which saves the driver most
// of its work.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <vector>

#include "shaders/embedded.h"

namespace isofield::shaders {

// Fixes the kernel's specialisation constants 0, 1, 2, ... to `constants` and others to their defaults, and removes the
// branches and functions that are dead then. The driver would reach the same result, but takes several times as long.
// INTERNAL: SPIRV-Tools fails.
absl::StatusOr<std::vector<std::uint32_t>> specialise(Spirv kernel, std::span<const std::uint32_t> constants);

// A number that changes with the version of SPIRV-Tools, for the keys of kernels that are kept on disk.
std::uint64_t specialiser_version();

}  // namespace isofield::shaders
