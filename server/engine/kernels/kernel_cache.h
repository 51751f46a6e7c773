// Keeps the compiled kernels of a device, by entry point and specialisation. It compiles a kernel on first use and
// frees those that were used least recently.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <utility>

#include "base/mutex.h"
#include "blobtree/tape/tape.h"
#include "engine/kernels/kernel_constants.h"
#include "engine/kernels/specialised_kernels.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "shaders/embedded.h"

namespace isofield::engine {

// The values to which a kernel that runs tapes is specialised (engine/kernels/kernel_constants.h).
struct KernelKind {
  blobtree::Codes codes;
  std::uint32_t stack_depth = 0;
  std::uint32_t tape_length = 0;  // instructions of each tape; 0: tapes of any length
  std::uint32_t arity = 0;        // most operands of an operator that takes all of them at once
  std::uint32_t volume_set = 0;   // slots of volumes, by bits (shaders/lib/volume.glsl)
  std::uint32_t uniform_set = 0;  // parameters that are read from uniform buffers (shaders/lib/parameters.glsl)

  // Returns the kind of a kernel that runs this tape and every tape pruned from it.
  static KernelKind of(const blobtree::Tape& tape);
  // Returns the kind of a kernel that runs only those pruned tapes that are a single leaf; it knows no operators.
  static KernelKind single_leaf(const blobtree::Tape& tape);

  // Returns the values of the specialisation constants 0, 1, 2, ...
  KernelConstants constants() const;
};

struct KernelOptions {
  // The most kernels that are kept; there are more only while they are compiled at the same time. A kernel takes some
  // 0.25 MB on lavapipe, and the mesh of a scene needs about a dozen.
  std::size_t most = 512;
  // The specialised kernels, which caches of other devices may share. Null: the cache makes its own.
  std::shared_ptr<SpecialisedKernels> specialised;
};

// Thread-safe. A kernel that two threads want at once is compiled once, and the second thread waits for it. A kernel
// that the cache frees lives on while somebody uses it.
class KernelCache {
 public:
  explicit KernelCache(gpu::Device& device, KernelOptions options = {})
      : device_(device),
        most_(options.most),
        specialised_(options.specialised ? std::move(options.specialised) : std::make_shared<SpecialisedKernels>()) {}

  // Returns the kernel, and compiles it if need be. It calls `waits` before it waits for the driver to compile. Errors
  // of the specialiser and the driver are returned and not kept: a later call compiles again.
  absl::StatusOr<gpu::SharedPipeline> get(const shaders::Spirv& shader, const KernelKind& kind = {},
                                          const std::function<void()>& waits = {});
  // Returns the variant of the shader that suits the device.
  const shaders::Spirv& of(const shaders::InRounds& shader) const;

  struct Counts {
    std::uint64_t held = 0, compiled = 0;
  };
  Counts counts() const;

 private:
  using Compiled = absl::StatusOr<gpu::SharedPipeline>;
  using Key = std::pair<const std::uint32_t*, KernelConstants>;
  struct Entry {
    std::shared_future<Compiled> kernel;
    std::uint64_t last_used = 0;  // the number of the call of get()
    bool is_ready = false;
  };

  Compiled compile(const shaders::Spirv& shader, const KernelKind& kind);
  // Returns false if all kernels are being compiled, so that none can be freed.
  bool forget_least_used() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  gpu::Device& device_;
  const std::size_t most_;
  const std::shared_ptr<SpecialisedKernels> specialised_;
  mutable base::Mutex mutex_;
  std::map<Key, Entry> kernels_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t uses_ ABSL_GUARDED_BY(mutex_) = 0, compiled_ ABSL_GUARDED_BY(mutex_) = 0;
};

// Gives one request its kernels. It calls `waits` whenever the request has to wait for a kernel to be compiled.
class Kernels {
 public:
  Kernels(KernelCache& cache, std::function<void()> waits) : cache_(cache), waits_(std::move(waits)) {}

  absl::StatusOr<gpu::SharedPipeline> get(const shaders::Spirv& shader, const KernelKind& kind = {}) const {
    return cache_.get(shader, kind, waits_);
  }
  const shaders::Spirv& of(const shaders::InRounds& shader) const { return cache_.of(shader); }

 private:
  KernelCache& cache_;
  const std::function<void()> waits_;
};

}  // namespace isofield::engine
