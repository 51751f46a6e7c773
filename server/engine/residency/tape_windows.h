// Pruned tapes on the device, in windows that kernels read as uniform buffers (shaders/lib/parameters.glsl says why).
// A tape too long for a window is read from a storage buffer.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <vector>

#include "blobtree/tape/window_packer.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/residency/resident_scene.h"
#include "engine/session.h"

namespace isofield::engine {

class TapeWindows {
 public:
  // `scene` must outlive it. `code` holds tapes pruned from the scene's.
  TapeWindows(const gpu::Device& device, const ResidentScene& scene, std::vector<blobtree::Instruction> code)
      : device_(&device), scene_(&scene), code_(std::move(code)), packer_(scene.tape(), scene.parameters(), code_) {}
  TapeWindows(const TapeWindows&) = delete;
  TapeWindows& operator=(const TapeWindows&) = delete;

  // As WindowPacker::add; what kernels are to be given as the tape's beginning.
  std::uint32_t add(std::uint32_t& begin, std::uint32_t count) {
    const std::uint32_t window = packer_.add(begin, count);
    has_long_tapes_ = has_long_tapes_ || window == kNoWindow;
    return window;
  }
  // After the last add().
  absl::Status upload(Session& session);

  // Of the tapes in one window, or in none: the kernel that runs them, and its bindings.
  KernelKind kind(const KernelKind& of, std::uint32_t window) const {
    return window == kNoWindow ? of : windowed(*device_, of);
  }
  gpu::Commands::Bindings bindings(std::uint32_t window, const gpu::Commands::Bindings& own) const;

  // The kernel of tapes in windows, whichever.
  static KernelKind windowed(const gpu::Device& device, const KernelKind& kind);

  static constexpr std::uint32_t kNoWindow = blobtree::WindowPacker::kNoWindow;

 private:
  const gpu::Device* device_;
  const ResidentScene* scene_;
  std::vector<blobtree::Instruction> code_;
  blobtree::WindowPacker packer_;
  bool has_long_tapes_ = false;
  gpu::Buffer windows_, long_tapes_;
};

}  // namespace isofield::engine
