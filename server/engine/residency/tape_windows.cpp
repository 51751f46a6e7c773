#include "engine/residency/tape_windows.h"

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"

namespace isofield::engine {
namespace {

static_assert(blobtree::kWindowSize * sizeof(blobtree::Float4) == gpu::kUniformBytes);
static_assert(blobtree::kWindowAlignment * sizeof(blobtree::Float4) == gpu::kUniformAlignment);

}  // namespace

KernelKind TapeWindows::windowed(const gpu::Device& device, const KernelKind& kind) {
  KernelKind in_windows = kind;
  in_windows.uniform_set = kLeavesAreUniform | kOperationsAreUniform | kTapeIsUniform |
                           (device.profile().shares_loads ? kLoadsAreShared : 0u);
  return in_windows;
}

absl::Status TapeWindows::upload(Session& session) {
  const std::vector<blobtree::Float4> data = packer_.finish();
  ISOFIELD_ASSIGN_OR_RETURN(windows_, session.upload(std::span(data)));
  if (has_long_tapes_) {
    ISOFIELD_ASSIGN_OR_RETURN(long_tapes_, session.upload(std::span(code_)));
  }
  code_ = {};
  return absl::OkStatus();
}

gpu::Commands::Bindings TapeWindows::bindings(std::uint32_t window, const gpu::Commands::Bindings& own) const {
  if (window == kNoWindow) return scene_->bindings(long_tapes_, own);
  gpu::Commands::Bindings all = scene_->bindings(windows_, own);
  const blobtree::Window& w = packer_.windows()[window];
  const auto bind = [&](std::uint32_t number, std::uint32_t place) {
    if (place == blobtree::Window::kWhole) return;
    std::erase_if(all, [&](const gpu::Commands::Binding& b) { return b.binding == number; });
    all.push_back({number, &windows_, place * sizeof(blobtree::Float4)});
  };
  bind(binding::scene::kUniformTape, w.code);
  bind(binding::scene::kUniformLeaves, w.leaves);
  bind(binding::scene::kUniformOperations, w.operations);
  return all;
}

}  // namespace isofield::engine
