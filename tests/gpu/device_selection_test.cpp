// Tests the choice among devices, on made-up devices.
#include "gpu/device_selection.h"

#include <gtest/gtest.h>

namespace isofield::gpu {
namespace {

using Type = DeviceCandidate::Type;

DeviceCandidate candidate(const char* name, Type type) {
  return {name, type, 1, 3, true, 16, 65'536, 256, true};
}

TEST(DeviceSelection, PrefersDiscreteDevices) {
  const auto choice = select_device({candidate("llvmpipe", Type::kCpu), candidate("Some GPU", Type::kDiscrete),
                                     candidate("Other", Type::kIntegrated)},
                                    "");
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(*choice, 1u);
}

TEST(DeviceSelection, TakesTheNamedOne) {
  const auto choice =
      select_device({candidate("Some GPU", Type::kDiscrete), candidate("llvmpipe (LLVM 15)", Type::kCpu)}, "LLVMpipe");
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(*choice, 1u);
}

TEST(DeviceSelection, SaysWhyEachWasRefused) {
  DeviceCandidate old = candidate("Old", Type::kDiscrete), small = candidate("Small", Type::kDiscrete);
  DeviceCandidate display = candidate("Display", Type::kOther);
  old.api_minor = 0;
  small.storage_buffers_per_stage = 4;
  display.has_compute_queue = false;
  DeviceCandidate narrow = candidate("Narrow", Type::kIntegrated);
  narrow.uniform_bytes = 16'384;
  DeviceCandidate lonely = candidate("Lonely", Type::kIntegrated);
  lonely.has_subgroup_operations = false;
  const absl::Status status = select_device({old, small, display, narrow, lonely}, "").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_NE(status.message().find("'Old' has Vulkan 1.0"), absl::string_view::npos) << status;
  EXPECT_NE(status.message().find("'Small' binds 4"), absl::string_view::npos) << status;
  EXPECT_NE(status.message().find("'Narrow' binds 16384 bytes of a uniform"), absl::string_view::npos) << status;
  EXPECT_NE(status.message().find("'Lonely' has no votes and shuffles"), absl::string_view::npos) << status;
  EXPECT_NE(status.message().find("'Display' has no compute queue"), absl::string_view::npos) << status;
  EXPECT_NE(select_device({}, "").status().message().find("mesa-vulkan-drivers"), absl::string_view::npos);
}

}  // namespace
}  // namespace isofield::gpu
