#include "engine/kernels/kernel_cache.h"

#include <chrono>

#include "base/least_used.h"
#include "base/status_macros.h"
#include "engine/request_times.h"
#include "gpu/commands.h"

namespace isofield::engine {
namespace {

using blobtree::Operand;
using blobtree::Operator;

std::uint32_t bit(Operand o) {
  return 1u << static_cast<std::uint32_t>(o);
}
std::uint32_t bit(Operator o) {
  return 1u << static_cast<std::uint32_t>(o);
}

// Few distinct depths, so that scenes share kernels.
std::uint32_t round_depth(std::uint32_t depth) {
  for (const std::uint32_t d : {0u, 1u, 2u, 4u, 8u}) {
    if (depth <= d) return d;
  }
  return blobtree::kMaxStackDepth;
}

// Parameters that fit into a uniform buffer.
std::uint32_t fitting_parameters(const blobtree::Tape& tape) {
  constexpr std::size_t kMost = gpu::kUniformBytes / 16;
  return (tape.leaf_records <= kMost ? 1u : 0u) | (tape.record_owners.size() <= kMost ? 2u : 0u);
}

}  // namespace

KernelKind KernelKind::of(const blobtree::Tape& tape) {
  KernelKind kind{tape.operand_set, tape.operator_set | bit(Operator::kPush), round_depth(tape.stack_depth)};
  kind.arity = round_depth(tape.arity);
  kind.volume_set = (1u << tape.volumes.size()) - 1;
  kind.uniform_set = fitting_parameters(tape);
  // Pruning may turn an exchanged difference with nothing to take away into a clamp.
  if (kind.operator_set & bit(Operator::kSubtractFrom)) kind.operator_set |= bit(Operator::kSubtract);
  return kind;
}

KernelKind KernelKind::single_leaf(const blobtree::Tape& tape) {
  KernelKind kind{tape.operand_set & ~(bit(Operand::kPop) | bit(Operand::kZero)), bit(Operator::kPush), 0, 1};
  kind.uniform_set = fitting_parameters(tape);
  return kind;
}

const shaders::Spirv& KernelCache::of(const shaders::InRounds& shader) const {
  return device_.description().type == "cpu" ? shader.narrow : shader.wide;
}

absl::StatusOr<gpu::SharedPipeline> KernelCache::get(const shaders::Spirv& shader, const KernelKind& kind,
                                                     const std::function<void()>& waits) {
  const Key key{reinterpret_cast<std::uintptr_t>(shader.data()),
                kind.operand_set,
                kind.operator_set,
                kind.stack_depth,
                kind.tape_length,
                kind.arity,
                kind.volume_set,
                kind.uniform_set};
  std::promise<Compiled> promise;
  std::shared_future<Compiled> kernel;
  bool compiles = false, is_ready = false;
  {
    const std::lock_guard lock(mutex_);
    if (kernels_.size() >= most_ && !kernels_.contains(key)) forget_least_used();
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
      const std::lock_guard lock(mutex_);
      if (compiled.ok()) {
        kernels_[key].is_ready = true;
        ++compiled_;
      } else {
        // A later request may find the memory that was missing.
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

void KernelCache::forget_least_used() {
  const auto oldest = base::least_used(kernels_, [](const Entry& entry) { return entry.is_ready; });
  if (oldest != kernels_.end()) kernels_.erase(oldest);
}

KernelCache::Counts KernelCache::counts() const {
  const std::lock_guard lock(mutex_);
  return {kernels_.size(), compiled_};
}

}  // namespace isofield::engine
