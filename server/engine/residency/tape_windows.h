// Puts pruned tapes on the device, cut into windows that kernels read as uniform buffers (shaders/lib/parameters.glsl
// says why). A kernel reads a tape that is too long for a window from a storage buffer.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <vector>

#include "blobtree/tape/window_packer.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/residency/resident_scene.h"
#include "engine/session.h"

namespace isofield::engine {

// Owns the tapes' buffers. Used by one thread: add() for each tape, then upload(); after that it does not change, and
// any thread may read it.
class TapeWindows {
 public:
  // `scene` must outlive it. `code` holds tapes pruned from the scene's.
  TapeWindows(const gpu::Device& device, const ResidentScene& scene, std::vector<blobtree::Instruction> code)
      : device_(&device), scene_(&scene), code_(std::move(code)), packer_(scene.tape(), scene.parameters(), code_) {}
  TapeWindows(const TapeWindows&) = delete;
  TapeWindows& operator=(const TapeWindows&) = delete;

  // Puts the `count` instructions from `begin` on into a window. Returns the window's number, or kNoWindow if the tape
  // is too long for one, and changes `begin` to what kernels must be given as the tape's beginning.
  std::uint32_t add(std::uint32_t& begin, std::uint32_t count) {
    const std::uint32_t window = packer_.add(begin, count);
    has_long_tapes_ = has_long_tapes_ || window == kNoWindow;
    return window;
  }
  // Uploads all tapes. Call it once, after the last add().
  absl::Status upload(Session& session);

  // These two return the kind and the bindings of the kernel that runs the tapes of one window, or tapes in no window.
  // `of` is the kind of the scene's kernels.
  KernelKind kind(const KernelKind& of, std::uint32_t window) const {
    return window == kNoWindow ? of : windowed(*device_, of);
  }
  gpu::Commands::Bindings bindings(std::uint32_t window, const gpu::Commands::Bindings& own) const;

  // Returns the kind of the kernel that runs tapes in windows; it is the same for all windows.
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
