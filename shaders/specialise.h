// Specialises a kernel before the driver sees it.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <vector>

#include "shaders/embedded.h"

namespace isofield::shaders {

// The kernel with specialisation constants 0, 1, 2, ... fixed to `constants`, others to their defaults, and without the
// branches and functions that are dead then. The driver would come to the same, but it takes several times as long to
// read the whole kernel as this does. INTERNAL: SPIRV-Tools fails.
absl::StatusOr<std::vector<std::uint32_t>> specialise(Spirv kernel, std::span<const std::uint32_t> constants);

// Changes where SPIRV-Tools do.
std::uint64_t specialiser_version();

}  // namespace isofield::shaders
