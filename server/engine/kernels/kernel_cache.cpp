#include "engine/kernels/kernel_cache.h"

#include <algorithm>
#include <chrono>

#include "base/least_used.h"
#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/request_times.h"
#include "gpu/commands.h"

namespace isofield::engine {
namespace {

using blobtree::Operand;
using operators::Opcode;

// Rounds a depth up to one of a few, so that more scenes share kernels.
std::uint32_t round_depth(std::uint32_t depth) {
  for (const std::uint32_t d : {0u, 1u, 2u, 4u, 8u}) {
    if (depth <= d) return d;
  }
  return blobtree::kMaxStackDepth;
}

// Returns the number of a set's only member, or kNone if it has none or several.
template <class Code>
std::uint32_t only(const blobtree::CodeSet<Code>& set) {
  if (set.size() != 1) return kNone;
  std::uint32_t number = 0;
  while (!set.has(static_cast<Code>(number))) ++number;
  return number;
}

std::uint32_t only_operand(const blobtree::Codes& codes) {
  return only(codes.operands);
}

std::uint32_t only_opcode(const blobtree::Codes& codes, std::uint32_t stack_depth) {
  const std::uint32_t operator_flags = codes.flags & ~blobtree::Codes::kSignedLeaves;
  if (stack_depth != 0 || operator_flags != 0) return kNone;
  blobtree::CodeSet<Opcode> joins = codes.opcodes;
  joins.remove(Opcode::kPush);
  return only(joins);
}

// Returns the bits of uniform_set for the parameters that fit into a uniform buffer.
std::uint32_t fitting_parameters(const blobtree::Tape& tape) {
  constexpr std::size_t kMost = gpu::kUniformBytes / 16;
  return (tape.leaf_records <= kMost ? kLeavesAreUniform : 0u) |
         (tape.record_owners.size() <= kMost ? kOperationsAreUniform : 0u);
}

}  // namespace

KernelKind KernelKind::of(const blobtree::Tape& tape) {
  KernelKind kind{tape.codes, round_depth(tape.stack_depth)};
  kind.codes.opcodes.add(Opcode::kPush);
  kind.arity = round_depth(tape.arity);
  kind.volume_set = (1u << tape.volumes.size()) - 1;
  kind.uniform_set = fitting_parameters(tape);
  // Pruning may turn an exchanged difference with nothing to take away into a clamp.
  if (kind.codes.opcodes.has(Opcode::kSubtractFrom)) kind.codes.opcodes.add(Opcode::kSubtract);
  return kind;
}

KernelKind KernelKind::single_leaf(const blobtree::Tape& tape) {
  KernelKind kind;
  kind.codes.operands = tape.codes.operands;
  kind.codes.operands.remove(Operand::kPop);
  kind.codes.operands.remove(Operand::kZero);
  kind.codes.opcodes.add(Opcode::kPush);
  kind.codes.flags = tape.codes.flags & blobtree::Codes::kSignedLeaves;
  kind.tape_length = 1;
  kind.uniform_set = fitting_parameters(tape);
  return kind;
}

KernelConstants KernelKind::constants() const {
  KernelConstants values{};
  const auto set = [&](KernelConstant constant, std::uint32_t value) {
    values[static_cast<std::size_t>(constant)] = value;
  };
  set(KernelConstant::kFlags, codes.flags);
  set(KernelConstant::kOnlyOperand, only_operand(codes));
  set(KernelConstant::kOnlyOpcode, only_opcode(codes, stack_depth));
  set(KernelConstant::kStackDepth, stack_depth);
  set(KernelConstant::kTapeLength, tape_length);
  set(KernelConstant::kArity, arity);
  set(KernelConstant::kVolumeSet, volume_set);
  set(KernelConstant::kUniformSet, uniform_set);
  auto word = values.begin() + static_cast<std::size_t>(KernelConstant::kCount);
  word = std::copy_n(codes.operands.words().begin(), kOperandWords, word);
  std::copy_n(codes.opcodes.words().begin(), kOpcodeWords, word);
  return values;
}

const shaders::Spirv& KernelCache::of(const shaders::InRounds& shader) const {
  return device_.profile().has_narrow_workgroups ? shader.narrow : shader.wide;
}

absl::StatusOr<gpu::SharedPipeline> KernelCache::get(const shaders::Spirv& shader, const KernelKind& kind,
                                                     const std::function<void()>& waits) {
  const Key key{shader.data(), kind.constants()};
  std::promise<Compiled> promise;
  std::shared_future<Compiled> kernel;
  bool compiles = false, is_ready = false;
  {
    const base::MutexLock lock(mutex_);
    while (kernels_.size() >= most_ && !kernels_.contains(key) && forget_least_used()) {
    }
    auto [it, added] = kernels_.try_emplace(key);
    if (added) {
      it->second.kernel = promise.get_future().share();
      compiles = true;
    }
    it->second.last_used = ++uses_;
    kernel = it->second.kernel;
    is_ready = it->second.is_ready;
  }
  if (is_ready) return kernel.get();
  if (waits) waits();
  const auto start = std::chrono::steady_clock::now();
  if (compiles) {
    Compiled compiled = compile(shader, kind);
    {
      const base::MutexLock lock(mutex_);
      if (compiled.ok()) {
        kernels_[key].is_ready = true;
        ++compiled_;
      } else {
        // The failure is not kept, because a later request may find the memory that was missing.
        kernels_.erase(key);
      }
    }
    promise.set_value(std::move(compiled));
  }
  kernel.wait();
  if (RequestTimes* const times = TimedScope::current()) {
    times->add_compiling(std::chrono::steady_clock::now() - start);
  }
  return kernel.get();
}

KernelCache::Compiled KernelCache::compile(const shaders::Spirv& shader, const KernelKind& kind) {
  ISOFIELD_ASSIGN_OR_RETURN(const SpecialisedKernels::Kernel kernel, specialised_->get(shader, kind.constants()));
  return gpu::Pipeline::create(device_, *kernel);
}

bool KernelCache::forget_least_used() {
  const auto oldest = base::least_used(kernels_, [](const Entry& entry) { return entry.is_ready; });
  if (oldest == kernels_.end()) return false;
  kernels_.erase(oldest);
  return true;
}

KernelCache::Counts KernelCache::counts() const {
  const base::MutexLock lock(mutex_);
  return {kernels_.size(), compiled_};
}

}  // namespace isofield::engine
