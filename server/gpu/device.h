// A Vulkan device with one compute queue. Buffers, pipelines and commands are made from it. The headers of gpu/ that
// other folders include keep Vulkan out of them.
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
  // Runs under the Khronos validation layer. Device::create() fails if the layer is not installed.
  bool validation = false;
  // Makes the profile neither map nor borrow memory, as if the host could not see the device's memory. Tests use this
  // to take the way of discrete devices on any device.
  bool always_stage = false;
  // Called with each validation message, from any thread.
  std::function<void(const std::string&)> on_validation_message;
};

// Thread-safe. It must outlive everything that is made from it.
class Device {
 public:
  // Opens the device that `options` ask for. NOT_FOUND: there is no usable device, no Vulkan, or no validation layer.
  // RESOURCE_EXHAUSTED: memory has run out. INTERNAL: the driver has failed in another way.
  static absl::StatusOr<std::unique_ptr<Device>> create(const DeviceOptions& options);
  ~Device();

  const DeviceDescription& description() const;
  const DeviceProfile& profile() const;
  // Returns the number of validation messages so far.
  std::uint64_t validation_messages() const;
  // Returns the bytes of all buffers in use. Small buffers that are kept to be used again take some MiB more.
  std::uint64_t allocated_bytes() const;

  // The order of access to the device's queue. Work that can take long, or that many ask for, takes a turn before it
  // submits.
  Turns& turns();

  struct Impl;  // gpu/device_impl.h
  Impl& impl() { return *impl_; }

 private:
  explicit Device(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace isofield::gpu
