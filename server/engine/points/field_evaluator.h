// Values and gradients of resident scenes, at points and on lattices.
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

// Thread-safe.
class FieldEvaluator {
 public:
  // `written` is null where all tapes are interpreted.
  FieldEvaluator(gpu::Device& device, KernelCache& kernels, base::Workers& workers, WrittenKernels* written = nullptr)
      : device_(device), kernels_(kernels), workers_(workers), written_(written) {}

  const gpu::DeviceProfile& profile() const { return device_.profile(); }

  // Asked between submissions; true ends the work with CANCELLED.
  using Cancelled = std::function<bool()>;

  struct Submission {
    gpu::Urgency urgency;
    gpu::Turns::Turn turn;  // one that is held already
  };

  // Compiles the kernels that the functions below would compile on first use.
  absl::Status prepare(const ResidentScene& scene, ResultLayout layout);

  // xyz: 3 finite numbers a point; out: a row of the layout a point. Where others write to xyz meanwhile, any numbers
  // come out for these points, and nothing else goes wrong.
  absl::Status evaluate(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout,
                        std::span<float> out, const Cancelled& cancelled = {}, Submission submission = {});

  // The lattice's points with k from first_layer (a multiple of kBrickCells) to the end of `out`, which holds whole
  // layers, x fastest. lattice.cells counts the points.
  absl::Status evaluate_layers(const ResidentScene& scene, const blobtree::Lattice& lattice, std::uint32_t first_layer,
                               ResultLayout layout, std::span<float> out, const Cancelled& cancelled = {});

 private:
  // The whole tape's at all points, or pruned ones' at sorted points.
  bool is_sorted(const ResidentScene& scene) const;

  absl::Status evaluate_written(const gpu::SharedPipeline& kernel, const ResidentScene& scene,
                                std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                                const Cancelled& cancelled, Submission submission);

  absl::Status evaluate_unsorted(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout,
                                 std::span<float> out, const Cancelled& cancelled, Submission submission);

  // Evaluates points in the batch's order, at most `most` in a submission. Calls dispatch(session, the bindings of
  // points and results, the last point, workgroups) for each submission.
  template <class Dispatch>
  absl::Status evaluate_in_order(std::size_t most, std::span<const float> xyz, ResultLayout layout,
                                 std::span<float> out, const Cancelled& cancelled, Submission submission,
                                 const Dispatch& dispatch);

  absl::Status evaluate_indexed(const PointIndex& index, const ResidentScene& scene, std::span<const float> xyz,
                                ResultLayout layout, std::span<float> out, const Cancelled& cancelled,
                                Submission submission);

  // Points of one tape, consecutive in Slab::sorted; the window as of TapeWindows::add. No tape: the field is 0.
  struct Bin {
    std::uint32_t first, count, tape_begin, tape_count, window;
  };
  // Points of a batch whose work is one submission, while it needs them.
  struct Slab {
    std::unique_ptr<blobtree::PlacedPoint[]> sorted;  // null: the points are as the batch has them
    Session session;                                  // the last member: it waits for the device, which uses the other
  };
  absl::StatusOr<Slab> begin_slab(Submission& submission);
  // Submits when `running`, if any, is done, and takes its place.
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
