#include "engine/residency/tape_windows.h"

#include "base/status_macros.h"

namespace isofield::engine {
namespace {

// shaders/lib/parameters.glsl.
constexpr std::uint32_t kLeaves = gpu::kFirstUniformBinding, kOperations = kLeaves + 1, kTape = kLeaves + 2;

// Of UNIFORM_SET: all that a window has, and whether invocations share loads.
constexpr std::uint32_t kUniformAll = 7, kSharedLoads = 8;

static_assert(blobtree::kWindowSize * sizeof(blobtree::Float4) == gpu::kUniformBytes);
static_assert(blobtree::kWindowAlignment * sizeof(blobtree::Float4) == gpu::kUniformAlignment);

}  // namespace

KernelKind TapeWindows::windowed(const gpu::Device& device, const KernelKind& kind) {
  KernelKind in_windows = kind;
  in_windows.uniform_set = kUniformAll | (device.profile().shares_loads ? kSharedLoads : 0u);
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
  const auto bind = [&](std::uint32_t binding, std::uint32_t place) {
    if (place == blobtree::Window::kWhole) return;
    std::erase_if(all, [&](const gpu::Commands::Binding& b) { return b.binding == binding; });
    all.push_back({binding, &windows_, place * sizeof(blobtree::Float4)});
  };
  bind(kTape, w.code);
  bind(kLeaves, w.leaves);
  bind(kOperations, w.operations);
  return all;
}

}  // namespace isofield::engine
