#include "engine/points/written_kernels.h"

#include <absl/strings/str_cat.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/least_used.h"
#include "base/status_macros.h"
#include "engine/points/tape_writer.h"
#include "shaders/tape_compiler.h"

namespace isofield::engine {
namespace {

// The most structures whose points are counted. Beyond this number, those that have reached no kernel are forgotten.
constexpr std::size_t kMostStructures = 1024;
constexpr int kNiceness = 10;

// The work of an instruction in a tape that is not all light, in light ones: eight spheres took 7 against 120 million
// points a second (measured).
constexpr std::size_t kHeavyWork = 16;

constexpr bool is_light(operators::Opcode op) {
  return operators::traits_of(op).weight == operators::Weight::kIsLight;
}

bool all_light(const blobtree::Tape& tape) {
  return std::all_of(tape.code.begin(), tape.code.end(), [](const auto& i) { return is_light(i.op()); });
}

// The longest tape that gets a kernel. For longer tapes, sorting the points and pruning the tape gain more.
std::size_t most_instructions(const blobtree::Tape& tape, const gpu::DeviceProfile& profile) {
  return all_light(tape) ? profile.written_instructions : profile.written_heavy_instructions;
}

}  // namespace

std::size_t WrittenKernels::work_of(const blobtree::Tape& tape) {
  return tape.code.size() * (all_light(tape) ? 1 : kHeavyWork);
}

WrittenKernels::WrittenKernels(gpu::Device& device, TierTwoOptions options)
    : device_(device), options_(std::move(options)), store_(options_.folder) {
  if (options_.is_on) worker_ = std::thread([this] { work(); });
}

WrittenKernels::~WrittenKernels() {
  {
    const base::MutexLock lock(mutex_);
    is_over_ = true;
  }
  wanted_more_.notify_all();
  if (worker_.joinable()) worker_.join();
}

WrittenKernels::Key WrittenKernels::key_of(const blobtree::Tape& tape, bool with_gradient) {
  Key key{with_gradient ? 1u : 0u};
  for (const std::uint32_t constant : KernelKind::of(tape).constants()) key.push_back(constant);
  for (const blobtree::Instruction& i : tape.code) key.insert(key.end(), {i.code, i.leaf, i.operation});
  return key;
}

gpu::SharedPipeline WrittenKernels::find(const ResidentScene& scene, bool with_gradient, std::uint64_t points) {
  const blobtree::Tape& tape = scene.tape();
  const bool is_short = tape.code.size() <= most_instructions(tape, device_.profile());
  if (!options_.is_on || !is_short || !is_writable(tape)) return nullptr;
  Key key = key_of(tape, with_gradient);
  const base::MutexLock lock(mutex_);
  if (entries_.size() >= kMostStructures && !entries_.contains(key)) forget_cold();
  Entry& entry = entries_[key];
  entry.points += points;
  entry.last_used = ++uses_;
  const bool becomes_hot = !entry.is_hot && entry.points >= options_.hot_points;
  if (becomes_hot && (counts_.held < options_.most_kernels || forget_least_used())) {
    entry.is_hot = true;
    ++counts_.held;
    wanted_.push_back({std::move(key), scene.shared_from_this(), with_gradient});
    wanted_more_.notify_one();
  }
  return entry.kernel;
}

void WrittenKernels::forget_cold() {
  std::erase_if(entries_, [](const auto& e) { return !e.second.is_hot; });
}

// A structure that loses its kernel must become hot again to get another.
bool WrittenKernels::forget_least_used() {
  const auto oldest = base::least_used(entries_, [](const Entry& entry) { return entry.kernel != nullptr; });
  if (oldest == entries_.end()) return false;
  entries_.erase(oldest);
  --counts_.held;
  return true;
}

void WrittenKernels::wait() {
  base::MutexLock lock(mutex_);
  while (!wanted_.empty() || is_at_work_) made_one_.wait(mutex_);
}

WrittenKernels::Counts WrittenKernels::counts() const {
  const base::MutexLock lock(mutex_);
  return counts_;
}

void WrittenKernels::work() {
  // On Linux this lowers the priority of this thread alone.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  base::MutexLock lock(mutex_);
  while (true) {
    while (!is_over_ && wanted_.empty()) wanted_more_.wait(mutex_);
    if (is_over_) return;
    Wanted wanted = std::move(wanted_.front());
    wanted_.pop_front();
    is_at_work_ = true;
    lock.unlock();
    auto kernel = make(wanted);
    wanted.scene.reset();
    lock.lock();
    // A structure that fails once would always fail, and stays with the interpreter.
    if (kernel.ok()) {
      entries_[wanted.key].kernel = *std::move(kernel);
      ++counts_.kernels;
    } else {
      --counts_.held;
      ++counts_.failures;
    }
    is_at_work_ = false;
    made_one_.notify_all();
  }
}

absl::StatusOr<std::vector<std::uint32_t>> WrittenKernels::spirv_of(const Wanted& wanted) {
  const std::string definitions = write_definitions(KernelKind::of(wanted.scene->tape()), wanted.with_gradient);
  const std::string tape = write_tape(wanted.scene->tape());
  const std::string text = absl::StrCat(absl::Hex(shaders::compiler_version()), "\n", definitions, tape);
  if (auto kept = store_.load(text)) {
    const base::MutexLock lock(mutex_);
    ++counts_.from_disk;
    return *std::move(kept);
  }
  ISOFIELD_ASSIGN_OR_RETURN(std::vector<std::uint32_t> spirv, shaders::compile_tape(definitions, tape));
  store_.save(text, spirv);
  return spirv;
}

absl::StatusOr<gpu::SharedPipeline> WrittenKernels::make(const Wanted& wanted) {
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> spirv, spirv_of(wanted));
  return gpu::Pipeline::create(device_, spirv);
}

}  // namespace isofield::engine
