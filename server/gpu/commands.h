// Work for the device: recorded, submitted once, waited for.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace isofield::gpu {

// For one thread at a time. Buffers that are used must live until wait() has returned; the commands keep pipelines
// alive until then. Destroying submitted commands waits for them.
class Commands {
 public:
  static absl::StatusOr<Commands> begin(Device& device);
  Commands(Commands&&) noexcept;
  Commands& operator=(Commands&&) noexcept;
  ~Commands();

  // A buffer at a binding. A part of a uniform buffer may be bound, whose offset is a multiple of kUniformAlignment.
  struct Binding {
    std::uint32_t binding;
    const Buffer* buffer;
    std::size_t offset = 0;
  };
  using Bindings = std::vector<Binding>;
  // Runs `groups` workgroups along x, at most kMaxGroups. Nothing is recorded for 0. Bindings that the pipeline
  // declares but its specialisation never reads may go unnamed.
  absl::Status dispatch(const SharedPipeline& pipeline, const Bindings& bindings,
                        std::span<const std::byte> push_constants, std::uint32_t groups);
  template <class Constants>
  absl::Status dispatch(const SharedPipeline& pipeline, const Bindings& bindings, const Constants& constants,
                        std::uint32_t groups) {
    return dispatch(pipeline, bindings, std::as_bytes(std::span(&constants, 1)), groups);
  }
  // Records a dispatch of no workgroups, which makes the driver compile the pipeline. `any` is bound in place of all
  // buffers.
  absl::Status dispatch_nothing(const SharedPipeline& pipeline, const Buffer& any);
  // Commands after the barrier see the results of those before it.
  void barrier();
  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset, std::size_t bytes);
  void fill_zero(const Buffer& buffer);

  // True where commands are recorded that have not been submitted.
  bool has_work() const;
  absl::Status submit();
  // Waits until the device is done. Returns at once where nothing has been submitted.
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

// Bindings from here on are uniform buffers, of which kernels see the first kUniformBytes: more than Vulkan's least
// limit, so device_selection asks for it.
inline constexpr std::uint32_t kFirstUniformBinding = 16;
inline constexpr std::size_t kUniformBytes = 65'536;
inline constexpr std::size_t kUniformAlignment = 256;  // the most that a Vulkan device may ask for

// Groups a dispatch may have.
inline constexpr std::uint32_t kMaxGroups = 65'535;

}  // namespace isofield::gpu
