#include "engine/compile_ahead.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "blobtree/tape/extent.h"
#include "engine/likely_edits.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {
namespace {

constexpr int kNiceness = 19;
// The number of cells along the longest edge of the mesh that is made; they suffice to need every kernel.
constexpr std::uint32_t kCells = 24;
// The most kernels that the second device holds. They are not used again; they are compiled to fill the driver's cache
// on disk.
constexpr std::size_t kMostKernels = 64;
// Beyond this number of mixes, all are forgotten and compiled again, which the driver's cache makes cheap.
constexpr std::size_t kMostMixes = 256;

}  // namespace

CompileAhead::CompileAhead(gpu::DeviceOptions device, const blobtree::SceneLimits& limits,
                           std::shared_ptr<SpecialisedKernels> specialised)
    : device_(std::move(device)), limits_(limits), specialised_(std::move(specialised)), worker_([this] { work(); }) {}

CompileAhead::~CompileAhead() {
  {
    const base::MutexLock lock(mutex_);
    is_over_ = true;
  }
  wanted_more_.notify_all();
  worker_.join();
}

CompileAhead::Mix CompileAhead::mix_of(const blobtree::Tape& tape) {
  const auto constants = KernelKind::of(tape).constants();
  return {constants.begin(), constants.end()};
}

void CompileAhead::edited(std::shared_ptr<const v1::Scene> scene,
                          std::shared_ptr<const blobtree::OperatorTable> operators, SceneLease lease) {
  Mix mix = mix_of(lease->tape());
  const base::MutexLock lock(mutex_);
  if (seen_.size() >= kMostMixes) {
    seen_.clear();
    done_.clear();
  }
  if (!seen_.insert(std::move(mix)).second) return;
  wanted_ = std::make_unique<Edited>(Edited{std::move(scene), std::move(operators), std::move(lease)});
  wanted_more_.notify_one();
}

void CompileAhead::wait() {
  base::MutexLock lock(mutex_);
  while (wanted_ || is_at_work_) is_idle_.wait(mutex_);
}

std::uint64_t CompileAhead::mixes() const {
  const base::MutexLock lock(mutex_);
  return done_.size();
}

bool CompileAhead::is_over() const {
  const base::MutexLock lock(mutex_);
  return is_over_;
}

void CompileAhead::work() {
  // On Linux this lowers the priority of this thread alone, and of the threads that it starts, which are the device's.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  base::MutexLock lock(mutex_);
  while (true) {
    while (!is_over_ && !wanted_) wanted_more_.wait(mutex_);
    if (is_over_) return;
    const std::unique_ptr<Edited> edited = std::move(wanted_);
    is_at_work_ = true;
    lock.unlock();
    compile_for(*edited);
    lock.lock();
    is_at_work_ = false;
    is_idle_.notify_all();
  }
}

void CompileAhead::compile_for(const Edited& edited) {
  if (!engine_) {
    absl::StatusOr<std::unique_ptr<Engine>> engine = Engine::create(
        device_, limits_, {}, {.is_on = false, .folder = {}}, {.most = kMostKernels, .specialised = specialised_});
    if (!engine.ok()) return;  // requests report the errors of their own device
    engine_ = *std::move(engine);
  }
  for (const v1::Scene& likely : likely_edits(*edited.scene, edited.lease->tape())) {
    if (is_over()) return;
    // A scene at its limits has no room for another node.
    const absl::StatusOr<SceneLease> scene = engine_->make_resident(likely, *edited.operators);
    if (!scene.ok()) continue;
    Mix mix = mix_of((*scene)->tape());
    {
      const base::MutexLock lock(mutex_);
      if (seen_.contains(mix) || !done_.insert(std::move(mix)).second) continue;
    }
    rehearse(*scene);
  }
}

void CompileAhead::rehearse(const SceneLease& scene) {
  const blobtree::Box& support = scene->tape().support;
  const bool is_bounded = !support.empty() && blobtree::is_bounded(scene->tape());
  MeshRequest request{.iso = scene->tape().law == operators::Law::kSigned ? 0.0 : 0.5};
  if (!is_bounded) request.bounds = blobtree::Box{{-1, -1, -1}, {1, 1, 1}};
  const double longest = blobtree::longest_edge(is_bounded ? support : *request.bounds);
  request.cell_size = std::max(longest / kCells, least_cell_size(scene->tape(), request));
  // Errors are ignored here, since a request that needs the kernel will report them.
  (void)engine_->mesher().mesh(*scene, request, {.cancelled = [this] { return is_over(); }});
  for (const ResultLayout layout : {ResultLayout::kValue, ResultLayout::kValueAndGradient}) {
    if (!is_over()) (void)engine_->fields().prepare(*scene, layout);
  }
}

}  // namespace isofield::engine
