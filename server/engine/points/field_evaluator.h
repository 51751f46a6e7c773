// FieldEvaluator computes values and gradients of resident scenes on the device, at points and on lattices.
#pragma once

#include <absl/status/status.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/workers.h"
#include "blobtree/cull/lattice.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/points/point_index.h"
#include "engine/points/result_layout.h"
#include "engine/points/written_kernels.h"
#include "engine/residency/resident_scene.h"
#include "engine/session.h"
#include "gpu/turns.h"

namespace isofield::engine {

// Thread-safe. Owns the indices of the scenes that are asked often; all that it is given must outlive it. Errors are
// those of the device, and CANCELLED.
class FieldEvaluator {
 public:
  // `written` is null where all tapes are interpreted.
  FieldEvaluator(gpu::Device& device, KernelCache& kernels, base::Workers& workers, WrittenKernels* written = nullptr)
      : device_(device), kernels_(kernels), workers_(workers), written_(written) {}

  const gpu::DeviceProfile& profile() const { return device_.profile(); }

  // The evaluator calls it between submissions; the answer true ends the work with CANCELLED.
  using Cancelled = std::function<bool()>;

  struct Submission {
    gpu::Urgency urgency;
    gpu::Turns::Turn turn;  // a turn that the caller holds already, or none
  };

  // Compiles the interpreting kernel that evaluate() would otherwise compile on first use.
  absl::Status prepare(const ResidentScene& scene, ResultLayout layout);

  // Evaluates the field at points. `xyz` has 3 finite numbers a point, and `out` a row of the layout a point. If
  // somebody writes to `xyz` meanwhile, the results of these points are arbitrary, and nothing else goes wrong.
  absl::Status evaluate(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout,
                        std::span<float> out, const Cancelled& cancelled = {}, Submission submission = {});

  // Evaluates the layers of lattice points from k = first_layer on, a multiple of kBrickCells; `out` holds as many
  // whole layers as are wanted, x fastest. Here lattice.cells counts the points along each axis.
  absl::Status evaluate_layers(const ResidentScene& scene, const blobtree::Lattice& lattice, std::uint32_t first_layer,
                               ResultLayout layout, std::span<float> out, const Cancelled& cancelled = {});

 private:
  // True: points are sorted, and pruned tapes run at them. False: the whole tape runs at all points.
  bool is_sorted(const ResidentScene& scene) const;

  absl::Status evaluate_written(const gpu::SharedPipeline& kernel, const ResidentScene& scene,
                                std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                                const Cancelled& cancelled, Submission submission);

  absl::Status evaluate_unsorted(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout,
                                 std::span<float> out, const Cancelled& cancelled, Submission submission);

  // Evaluates points in the order of the batch, at most `most` in a submission. For each submission it calls
  // dispatch(session, bindings of points and results, number of the last point, workgroups).
  template <class Dispatch>
  absl::Status evaluate_in_order(std::size_t most, std::span<const float> xyz, ResultLayout layout,
                                 std::span<float> out, const Cancelled& cancelled, Submission submission,
                                 const Dispatch& dispatch);

  absl::Status evaluate_indexed(const PointIndex& index, const ResidentScene& scene, std::span<const float> xyz,
                                ResultLayout layout, std::span<float> out, const Cancelled& cancelled,
                                Submission submission);

  // The points of one tape, which are consecutive in Slab::sorted. `window` is what TapeWindows::add returned. If
  // tape_count is 0, the field is 0 there.
  struct Bin {
    std::uint32_t first, count, tape_begin, tape_count, window;
  };
  // The points of a batch whose work is one submission, and the session that does it.
  struct Slab {
    std::unique_ptr<blobtree::PlacedPoint[]> sorted;  // null: the points have the order of the batch
    Session session;  // the last member, since it waits for the device, which reads `sorted`
  };
  absl::StatusOr<Slab> begin_slab(Submission& submission);
  // Waits until `running`, if there is one, is done; then submits `next`, which becomes the running one.
  static absl::Status submit_after(std::optional<Slab>& running, Slab next);
  static absl::Status finish(std::optional<Slab>& running);
  std::uint32_t points_per_job() const { return static_cast<std::uint32_t>(profile().points_per_job); }
  absl::Status record(Slab& slab, const ResidentScene& scene, const TapeWindows& tapes, std::span<const Bin> bins,
                      ResultLayout layout, std::span<float> out, const Cancelled& cancelled);

  gpu::Device& device_;
  KernelCache& kernels_;
  base::Workers& workers_;
  WrittenKernels* written_;
  PointIndexCache indices_;
};

}  // namespace isofield::engine
