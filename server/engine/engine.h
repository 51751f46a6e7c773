// The facade of this folder: an Engine owns a GPU device and everything that runs on it. The rooms above (scenes/,
// rpc/) do their work on the device through it.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "base/workers.h"
#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesher.h"
#include "engine/points/evaluation_queue.h"
#include "engine/points/field_evaluator.h"
#include "engine/points/operator_evaluator.h"
#include "engine/points/written_kernels.h"
#include "engine/residency/resident_scene.h"
#include "engine/surface/ray_caster.h"
#include "engine/surface/surface_projector.h"
#include "gpu/device.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::engine {

// Owns the device, the compiled kernels, the volumes, and the evaluators and the mesher that work on them. Thread-safe.
// Scenes that it has made resident must not outlive it. `tier_two` is about kernels that are written for one structure.
class Engine {
 public:
  static absl::StatusOr<std::unique_ptr<Engine>> create(const gpu::DeviceOptions& options,
                                                        const blobtree::SceneLimits& limits,
                                                        const QueueOptions& queue = {},
                                                        const TierTwoOptions& tier_two = {},
                                                        const KernelOptions& kernels = {});

  // Validates, compiles and uploads a scene. `operators` holds the operators that custom nodes name. INVALID_ARGUMENT:
  // the scene breaks a rule of scene.proto.
  absl::StatusOr<SceneLease> make_resident(const v1::Scene& scene, const blobtree::OperatorTable& operators = {});

  // Returns the resident form of `edited`, which differs from the scene of `before` only in numbers of `nodes`. If
  // these numbers are all profiles of blends, it compiles nothing and uploads only the operators' parameters.
  absl::StatusOr<SceneLease> edit(const ResidentScene& before, const v1::Scene& edited,
                                  const std::vector<std::uint32_t>& nodes, const blobtree::OperatorTable& operators);

  VolumeCache& volumes() { return volumes_; }

  // Both put a batch of points into the queue that all requests share; evaluate() waits for the results, and submit()
  // calls `done` when they are there. Errors are those of compiling the kernels and of EvaluationQueue.
  absl::Status evaluate(const PointBatch& batch);
  void submit(PointBatch batch, EvaluationQueue::Done done);

  gpu::Device& device() { return *device_; }
  FieldEvaluator& fields() { return fields_; }
  WrittenKernels& written_kernels() { return written_; }
  Mesher& mesher() { return mesher_; }
  RayCaster& rays() { return rays_; }
  SurfaceProjector& projector() { return projector_; }
  OperatorEvaluator& operators() { return operators_; }

 private:
  Engine(std::unique_ptr<gpu::Device> device, const blobtree::SceneLimits& limits, const QueueOptions& queue,
         const TierTwoOptions& tier_two, const KernelOptions& kernels);
  // Compiles the kernels that the batch needs and that are missing.
  absl::Status prepare(const PointBatch& batch);

  std::unique_ptr<gpu::Device> device_;
  blobtree::SceneLimits limits_;
  base::Workers workers_;
  KernelCache kernels_;
  VolumeCache volumes_;
  WrittenKernels written_;
  FieldEvaluator fields_;
  EvaluationQueue queue_;
  Mesher mesher_;
  RayCaster rays_;
  SurfaceProjector projector_;
  OperatorEvaluator operators_;
};

}  // namespace isofield::engine
