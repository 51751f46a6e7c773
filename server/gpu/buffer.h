// A buffer of bytes that the device reads and writes: kernels bind it as a storage or uniform buffer, and copies may
// start or end in it.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "gpu/device.h"

namespace isofield::gpu {

// Owns its memory, except when it borrows the host's. A small buffer that is destroyed leaves its memory to later
// buffers of the same use and size class. Movable; not thread-safe.
class Buffer {
 public:
  enum class Use {
    kDevice,    // read and written by shaders; mapped if the device's memory is the host's, as with lavapipe
    kUpload,    // written by the host
    kReadback,  // read by the host
  };

  // Makes a buffer of undefined content; `bytes` is rounded up to a multiple of 16, and to at least 16.
  // RESOURCE_EXHAUSTED: memory has run out, or one binding cannot hold so many bytes.
  static absl::StatusOr<Buffer> create(Device& device, std::size_t bytes, Use use);
  // Makes a buffer whose memory is the host's `bytes`, which must outlive the device's use of it, so that nothing is
  // copied. Returns nothing if the device cannot do that, if its profile advises against it, or if the address is not a
  // multiple of 16.
  static std::optional<Buffer> borrow(Device& device, std::span<std::byte> bytes);
  Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  ~Buffer();

  std::size_t size() const;
  // Returns the buffer's memory as the host sees it, or null if it is not mapped. The memory is coherent.
  std::byte* data() const;

  struct Impl;  // gpu/buffer_impl.h
  const Impl& impl() const { return *impl_; }

 private:
  // Destroys a buffer, or leaves a small one to be used again.
  struct Release {
    void operator()(Impl* impl) const;
  };
  explicit Buffer(std::unique_ptr<Impl> impl) : impl_(impl.release()) {}
  std::unique_ptr<Impl, Release> impl_;
};

}  // namespace isofield::gpu
