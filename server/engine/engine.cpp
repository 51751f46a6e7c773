#include "engine/engine.h"

#include <algorithm>
#include <thread>

#include "base/guarded.h"
#include "base/status_macros.h"
#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/blend_edit.h"
#include "blobtree/tape/compiler.h"

namespace isofield::engine {

Engine::Engine(std::unique_ptr<gpu::Device> device, const blobtree::SceneLimits& limits, const QueueOptions& queue,
               const TierTwoOptions& tier_two, const KernelOptions& kernels)
    : device_(std::move(device)),
      limits_(limits),
      workers_(std::max(std::thread::hardware_concurrency(), 1u) - 1),
      kernels_(*device_, kernels),
      volumes_(*device_, kernels_),
      written_(*device_, tier_two),
      fields_(*device_, kernels_, workers_, &written_),
      queue_(
          device_->turns(), device_->profile(),
          [this](const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                 const FieldEvaluator::Cancelled& cancelled, FieldEvaluator::Submission submission) {
            return fields_.evaluate(scene, xyz, layout, out, cancelled, std::move(submission));
          },
          queue),
      mesher_(*device_, kernels_, workers_),
      rays_(fields_),
      projector_(fields_),
      operators_(*device_, kernels_, volumes_) {}

absl::StatusOr<std::unique_ptr<Engine>> Engine::create(const gpu::DeviceOptions& options,
                                                       const blobtree::SceneLimits& limits, const QueueOptions& queue,
                                                       const TierTwoOptions& tier_two, const KernelOptions& kernels) {
  ISOFIELD_ASSIGN_OR_RETURN(auto device, gpu::Device::create(options));
  return std::unique_ptr<Engine>(new Engine(std::move(device), limits, queue, tier_two, kernels));
}

absl::StatusOr<SceneLease> Engine::make_resident(const v1::Scene& scene, const blobtree::OperatorTable& operators) {
  ISOFIELD_ASSIGN_OR_RETURN(const blobtree::Scene valid, blobtree::read_scene(scene, limits_, operators));
  ISOFIELD_ASSIGN_OR_RETURN(blobtree::Tape tape, blobtree::compile(valid));
  return ResidentScene::create(*device_, volumes_, std::move(tape));
}

absl::StatusOr<SceneLease> Engine::edit(const ResidentScene& before, const v1::Scene& edited,
                                        const std::vector<std::uint32_t>& nodes,
                                        const blobtree::OperatorTable& operators) {
  ISOFIELD_ASSIGN_OR_RETURN(std::optional<blobtree::Tape> tape,
                            blobtree::edit_blends(before.tape(), edited, nodes, limits_));
  if (tape) return before.with_operations(*device_, *std::move(tape));
  return make_resident(edited, operators);
}

// Compiles the kernels of a batch before it joins the queue, so that batches that do not need them do not wait.
absl::Status Engine::prepare(const PointBatch& batch) {
  RequestTimes unasked;
  const TimedScope timed(batch.times ? *batch.times : unasked);
  return fields_.prepare(*batch.scene, batch.layout);
}

absl::Status Engine::evaluate(const PointBatch& batch) {
  ISOFIELD_RETURN_IF_ERROR(prepare(batch));
  return queue_.evaluate(batch);
}

void Engine::submit(PointBatch batch, EvaluationQueue::Done done) {
  if (const absl::Status s = base::guarded([&] { return prepare(batch); }); !s.ok()) return done(s);
  queue_.submit(std::move(batch), std::move(done));
}

}  // namespace isofield::engine
