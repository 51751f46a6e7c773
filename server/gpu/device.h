// A Vulkan device with one compute queue: the root object of this room. All of gpu/ keeps Vulkan out of its headers.
#pragma once

#include <absl/status/statusor.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "gpu/device_description.h"
#include "gpu/device_profile.h"
#include "gpu/turns.h"

namespace isofield::gpu {

struct DeviceOptions {
  // Part of the name of the device to use; empty: the best one.
  std::string name;
  // The Khronos validation layer; an error when it is not installed.
  bool validation = false;
  // Never maps device memory, as if the host could not see it: the road of discrete devices, testable on any.
  bool always_stage = false;
  // Called with each validation message, from any thread.
  std::function<void(const std::string&)> on_validation_message;
};

// Thread-safe. Must outlive all that is made from it.
class Device {
 public:
  // NOT_FOUND: no usable device, or no validation layer. INTERNAL: the driver failed.
  static absl::StatusOr<std::unique_ptr<Device>> create(const DeviceOptions& options);
  ~Device();

  const DeviceDescription& description() const;
  const DeviceProfile& profile() const;
  // Validation messages so far.
  std::uint64_t validation_messages() const;
  // Bytes of buffers in use now. Some MiB more of small ones are kept to be used again.
  std::uint64_t allocated_bytes() const;

  // Of its queue: what can take long, or is asked by many, submits in its turn.
  Turns& turns();

  struct Impl;  // gpu/device_impl.h
  Impl& impl() { return *impl_; }

 private:
  explicit Device(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield::gpu
