// A storage buffer on the device.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "gpu/device.h"

namespace isofield::gpu {

// Owns its memory; movable. Not thread-safe.
class Buffer {
 public:
  enum class Use {
    kDevice,    // read and written by shaders; mapped where the device's own memory is the host's (lavapipe)
    kUpload,    // written by the host
    kReadback,  // read by the host
  };

  // `bytes` is rounded up to a multiple of 16 and to at least 16. RESOURCE_EXHAUSTED: out of memory, or more than one
  // binding holds.
  static absl::StatusOr<Buffer> create(Device& device, std::size_t bytes, Use use);
  // A buffer that is the host's own bytes, which must outlive the device's use of it; nothing where the device cannot
  // or had better not, or where the address is no multiple of 16.
  static std::optional<Buffer> borrow(Device& device, std::span<std::byte> bytes);
  Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  ~Buffer();

  std::size_t size() const;
  // Null unless the memory is mapped; coherent.
  std::byte* data() const;

  struct Impl;  // gpu/buffer_impl.h
  const Impl& impl() const { return *impl_; }

 private:
  // Leaves a small one to be used again.
  struct Release {
    void operator()(Impl* impl) const;
  };
  explicit Buffer(std::unique_ptr<Impl> impl) : impl_(impl.release()) {}
  std::unique_ptr<Impl, Release> impl_;
};

}  // namespace isofield::gpu
