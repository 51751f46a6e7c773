// Pipelines by entry point and specialisation, compiled on first use and kept.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <mutex>

#include "blobtree/tape.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "shaders/embedded.h"

namespace isofield::engine {

// What a tape-running kernel is specialised to (shaders/lib/opcodes.glsl).
struct KernelKind {
  std::uint32_t operand_set = 0, operator_set = 0, stack_depth = 0;
  std::uint32_t tape_length = 0;  // 0: any
  std::uint32_t arity = 0;        // most operands of an n-ary operator
  std::uint32_t volume_set = 0;   // slots of volumes, by bits (shaders/lib/volume.glsl)
  std::uint32_t uniform_set = 0;  // parameters that are read from uniform buffers (shaders/lib/parameters.glsl)

  // For every tape pruned from this one.
  static KernelKind of(const blobtree::Tape& tape);
  // For those of them that are one leaf.
  static KernelKind single_leaf(const blobtree::Tape& tape);

  // As specialisation constants 0, 1, 2, ...
  std::array<std::uint32_t, 7> constants() const {
    return {operand_set, operator_set, stack_depth, tape_length, arity, volume_set, uniform_set};
  }
};

// Thread-safe. A kernel that two threads want is compiled once, and the second waits.
class KernelCache {
 public:
  explicit KernelCache(gpu::Device& device) : device_(device) {}

  absl::StatusOr<const gpu::Pipeline*> get(const shaders::Spirv& shader, const KernelKind& kind = {});
  // That which suits the device.
  const shaders::Spirv& of(const shaders::InRounds& shader) const;

 private:
  using Compiled = absl::StatusOr<std::shared_ptr<const gpu::Pipeline>>;
  using Key = std::array<std::uintptr_t, 8>;

  gpu::Device& device_;
  std::mutex mutex_;
  std::map<Key, std::shared_future<Compiled>> kernels_;
};

}  // namespace isofield::engine
