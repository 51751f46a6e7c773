// Commands are work for the device: the caller records dispatches and copies, submits them once, and waits.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace isofield::gpu {

// One thread at a time may use an object. Buffers in use must live until wait() has returned; the commands keep the
// pipelines alive until then. The destructor of submitted commands waits for them. Functions that return a status fail
// with RESOURCE_EXHAUSTED if memory runs out, else with INTERNAL.
class Commands {
 public:
  static absl::StatusOr<Commands> begin(Device& device);
  Commands(Commands&&) noexcept;
  Commands& operator=(Commands&&) noexcept;
  ~Commands();

  // Binds a buffer, from `offset` in bytes on, at a number that shaders know. The offset of a uniform buffer must be a
  // multiple of kUniformAlignment.
  struct Binding {
    std::uint32_t binding;
    const Buffer* buffer;
    std::size_t offset = 0;
  };
  using Bindings = std::vector<Binding>;
  // Records a dispatch of `groups` workgroups along x, at most kMaxGroups; 0 records nothing. Bindings that the
  // pipeline declares but its specialisation never reads may be left out.
  absl::Status dispatch(const SharedPipeline& pipeline, const Bindings& bindings,
                        std::span<const std::byte> push_constants, std::uint32_t groups);
  template <class Constants>
  absl::Status dispatch(const SharedPipeline& pipeline, const Bindings& bindings, const Constants& constants,
                        std::uint32_t groups) {
    return dispatch(pipeline, bindings, std::as_bytes(std::span(&constants, 1)), groups);
  }
  // Records a dispatch of no workgroups, which makes the driver compile the pipeline. `any` is bound at all bindings.
  absl::Status dispatch_nothing(const SharedPipeline& pipeline, const Buffer& any);
  // Makes commands after the barrier see the results of commands before it.
  void barrier();
  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset, std::size_t bytes);
  void fill_zero(const Buffer& buffer);

  // Tells whether any work has been recorded.
  bool has_work() const;
  // Gives what is recorded to the device's queue. It may be called once.
  absl::Status submit();
  // Waits until the device is done. Returns at once if nothing has been submitted.
  absl::Status wait();

  struct Impl;

 private:
  absl::Status record(const SharedPipeline& pipeline, const Bindings& bindings,
                      std::span<const std::byte> push_constants, std::uint32_t groups);
  // Waits for the device, and hands the object back to be used again.
  struct Release {
    void operator()(Impl* impl) const;
  };
  explicit Commands(std::unique_ptr<Impl> impl) : impl_(impl.release()) {}
  std::unique_ptr<Impl, Release> impl_;
};

// Bindings from kFirstUniformBinding on are uniform buffers, of which kernels see the first kUniformBytes. Vulkan does
// not guarantee so many bytes, so device_selection asks for a device that has them.
inline constexpr std::uint32_t kFirstUniformBinding = 16;
inline constexpr std::size_t kUniformBytes = 65'536;
inline constexpr std::size_t kUniformAlignment = 256;  // the largest alignment that a Vulkan device may require

// The most workgroups that a dispatch may have.
inline constexpr std::uint32_t kMaxGroups = 65'535;

}  // namespace isofield::gpu
