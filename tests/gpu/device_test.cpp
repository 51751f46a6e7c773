#include "gpu/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "gpu/vulkan.h"

namespace isofield::gpu {
namespace {

// Sets a variable of the environment, and restores it at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* const name_;
  std::optional<std::string> before_;
};

TEST(Device, IsNotFoundWhereNoDriverIsInstalled) {
  const Variable drivers("VK_DRIVER_FILES", "/nonexistent"), icds("VK_ICD_FILENAMES", "/nonexistent");
  const absl::Status status = Device::create({}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound) << status;
  EXPECT_NE(std::string(status.message()).find("mesa-vulkan-drivers"), std::string::npos) << status;
}

TEST(VulkanErrors, AreToldApart) {
  const auto code_of = [](vk::Result result) {
    return to_status(vk::SystemError(vk::make_error_code(result), "vkTest"), "testing").code();
  };
  EXPECT_EQ(code_of(vk::Result::eErrorOutOfDeviceMemory), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(code_of(vk::Result::eErrorOutOfHostMemory), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(code_of(vk::Result::eErrorIncompatibleDriver), absl::StatusCode::kNotFound);
  EXPECT_EQ(code_of(vk::Result::eErrorDeviceLost), absl::StatusCode::kInternal);
  EXPECT_EQ(code_of(vk::Result::eErrorInitializationFailed), absl::StatusCode::kInternal);
}

}  // namespace
}  // namespace isofield::gpu
