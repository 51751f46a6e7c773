#include "engine/points/field_evaluator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "base/status_macros.h"
#include "blobtree/cull/point_bins.h"
#include "engine/dealing.h"
#include "engine/kernels/bindings.h"
#include "engine/residency/tape_windows.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

using blobtree::Brick;

// A job of a subgroup of shaders/sorted_points.comp: beginning and length of the tape, first and last point.
using PointJob = std::array<std::uint32_t, 4>;
// The invocations of a workgroup of shaders/sorted_points.comp, points.comp and tape_points.comp.
constexpr std::uint32_t kPointsPerGroup = 64;
// The most points of a dispatch that takes points in the order of the batch.
constexpr std::size_t kMostPoints = std::size_t{gpu::kMaxGroups} * kPointsPerGroup;

// The jobs of one dispatch.
struct JobRun {
  std::size_t first;
  std::uint32_t count, window;
  bool waits;  // true: the dispatch is recorded only after all earlier work is done
};

// Cuts the list of jobs into dispatches, and deals out the jobs of each (engine/dealing.h). `windows` has the window of
// each job's tape; the jobs of a dispatch share one. After every DeviceProfile::submission_work the next run waits.
template <class Job, class Work>
std::vector<JobRun> runs_of(std::vector<Job>& jobs, std::span<const std::uint32_t> windows, const gpu::Device& device,
                            const Work& work_of) {
  const std::uint64_t most_work = device.profile().submission_work;
  std::vector<JobRun> runs;
  std::uint64_t work = 0;
  for (std::size_t first = 0, end = 0; first < windows.size(); first = end) {
    const bool waits = work >= most_work;
    if (waits) work = 0;
    while (end < windows.size() && windows[end] == windows[first] && end - first < gpu::kMaxGroups &&
           (end == first || work < most_work)) {
      work += work_of(jobs[end++]);
    }
    runs.push_back({first, static_cast<std::uint32_t>(end - first), windows[first], waits});
    deal(jobs, first, end, device.profile().dispatch_runs);
  }
  return runs;
}

template <class Dispatch>
absl::Status record_runs(Session& session, std::span<const JobRun> runs, const FieldEvaluator::Cancelled& cancelled,
                         const Dispatch& dispatch) {
  for (const JobRun& run : runs) {
    if (run.waits) ISOFIELD_RETURN_IF_ERROR(session.flush());
    if (cancelled && cancelled()) return absl::CancelledError("the request was cancelled");
    ISOFIELD_RETURN_IF_ERROR(dispatch(run));
  }
  return absl::OkStatus();
}

const shaders::Spirv& points_shader(ResultLayout layout, bool is_sorted) {
  if (layout.has(Quantity::kGradient)) return is_sorted ? shaders::kSortedPointsGradient : shaders::kPointsGradient;
  return is_sorted ? shaders::kSortedPointsValue : shaders::kPointsValue;
}

// The push constants of shaders/grid.comp.
struct GridConstants {
  float origin[4];
  float spacing[4];
  std::uint32_t counts[3];
  std::uint32_t first_brick;
  std::uint32_t first_layer;
  std::uint32_t layers;
};
static_assert(offsetof(GridConstants, spacing) == 16 && offsetof(GridConstants, counts) == 32 &&
              offsetof(GridConstants, first_brick) == 44 && offsetof(GridConstants, layers) == 52);

}  // namespace

bool FieldEvaluator::is_sorted(const ResidentScene& scene) const {
  return scene.tape().code.size() > profile().unsorted_instructions;
}

absl::Status FieldEvaluator::prepare(const ResidentScene& scene, ResultLayout layout) {
  return kernels_
      .get(points_shader(layout, is_sorted(scene)), TapeWindows::windowed(device_, KernelKind::of(scene.tape())))
      .status();
}

absl::Status FieldEvaluator::evaluate(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout,
                                      std::span<float> out, const Cancelled& cancelled, Submission submission) {
  const std::size_t count = xyz.size() / 3;
  if (count == 0) return absl::OkStatus();
  const bool with_gradient = layout.has(Quantity::kGradient);
  const gpu::SharedPipeline written = written_ ? written_->find(scene, with_gradient, count) : nullptr;
  if (written) return evaluate_written(written, scene, xyz, layout, out, cancelled, std::move(submission));
  if (!is_sorted(scene)) return evaluate_unsorted(scene, xyz, layout, out, cancelled, std::move(submission));
  const bool may_make = !submission.turn;  // making an index takes a turn of its own
  ISOFIELD_ASSIGN_OR_RETURN(const auto index, indices_.find(device_, scene, count, may_make, cancelled));
  if (index) return evaluate_indexed(*index, scene, xyz, layout, out, cancelled, std::move(submission));
  blobtree::PointBins binned = blobtree::bin_points(scene.tape(), xyz);
  TapeWindows tapes(device_, scene, std::move(binned.code));
  std::vector<Bin> bins;
  for (const blobtree::PointGroup& g : binned.groups) {
    Bin bin{g.first, g.count, g.tape_begin, g.tape_count, 0};
    if (g.tape_count > 0) bin.window = tapes.add(bin.tape_begin, g.tape_count);
    bins.push_back(bin);
  }
  ISOFIELD_ASSIGN_OR_RETURN(Slab slab, begin_slab(submission));
  slab.sorted = std::move(binned.points);
  ISOFIELD_RETURN_IF_ERROR(tapes.upload(slab.session));
  ISOFIELD_RETURN_IF_ERROR(record(slab, scene, tapes, bins, layout, out, cancelled));
  return slab.session.run();
}

absl::Status FieldEvaluator::evaluate_indexed(const PointIndex& index, const ResidentScene& scene,
                                              std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                                              const Cancelled& cancelled, Submission submission) {
  const std::size_t count = xyz.size() / 3, bricks = index.tapes().size();
  const std::size_t most = std::max<std::size_t>(profile().indexed_points, profile().indexed_points_per_brick * bricks);
  const std::uint32_t points_per_job = this->points_per_job();
  std::optional<Slab> running;
  for (std::size_t first = 0; first < count; first += most) {
    if (cancelled && cancelled()) return absl::CancelledError("the request was cancelled");
    const std::size_t part = std::min(most, count - first);
    const std::span<const float> part_xyz = xyz.subspan(3 * first, 3 * part);
    blobtree::PointGrid::Sorted sorted = index.grid().sort(part_xyz, workers_.for_each());
    std::vector<Bin> bins;
    std::uint64_t work = 0;
    for (std::size_t b = 0; b <= bricks; ++b) {
      const std::uint32_t begin = sorted.starts[b], points = sorted.starts[b + 1] - begin;
      if (points == 0) continue;
      const PointIndex::Tape tape = b < bricks ? index.tapes()[b] : PointIndex::Tape{};
      bins.push_back({begin, points, tape.begin, tape.count, tape.window});
      work += std::uint64_t{(points + points_per_job - 1) / points_per_job * points_per_job} * tape.count;
    }
    // If the slab is too much for one submission, record() submits parts of it, which need the turn that `running`
    // holds.
    if (work >= profile().submission_work) ISOFIELD_RETURN_IF_ERROR(finish(running));
    ISOFIELD_ASSIGN_OR_RETURN(Slab slab, begin_slab(submission));
    slab.sorted = std::move(sorted.points);
    ISOFIELD_RETURN_IF_ERROR(record(slab, scene, index.windows(), bins, layout,
                                    out.subspan(layout.numbers(first), layout.numbers(part)), cancelled));
    ISOFIELD_RETURN_IF_ERROR(submit_after(running, std::move(slab)));
  }
  return finish(running);
}

absl::Status FieldEvaluator::submit_after(std::optional<Slab>& running, Slab next) {
  if (running) ISOFIELD_RETURN_IF_ERROR(running->session.wait());
  ISOFIELD_RETURN_IF_ERROR(next.session.submit());
  if (running) running->session.collect();
  running = std::move(next);
  return absl::OkStatus();
}

absl::Status FieldEvaluator::finish(std::optional<Slab>& running) {
  if (running) {
    ISOFIELD_RETURN_IF_ERROR(running->session.wait());
    running->session.collect();
  }
  running.reset();
  return absl::OkStatus();
}

absl::StatusOr<FieldEvaluator::Slab> FieldEvaluator::begin_slab(Submission& submission) {
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_, submission.urgency, std::move(submission.turn)));
  submission.turn = {};
  return Slab{nullptr, std::move(session)};
}

absl::Status FieldEvaluator::record(Slab& slab, const ResidentScene& scene, const TapeWindows& tapes,
                                    std::span<const Bin> bins, ResultLayout layout, std::span<float> out,
                                    const Cancelled& cancelled) {
  const std::size_t count = out.size() / layout.numbers();
  const std::uint32_t points_per_job = this->points_per_job();
  const std::uint32_t jobs_per_group = kPointsPerGroup / points_per_job;
  std::vector<PointJob> jobs;
  std::vector<std::uint32_t> windows;
  const auto with_tape = std::find_if(bins.begin(), bins.end(), [](const Bin& b) { return b.tape_count > 0; });
  if (with_tape == bins.end()) {
    std::fill(out.begin(), out.end(), 0.0f);
    return absl::OkStatus();
  }
  jobs.reserve(count / points_per_job + bins.size());
  windows.reserve(jobs.capacity());
  std::uint32_t window = with_tape->window;  // points where the field is 0 may go with any window
  for (const Bin& b : bins) {
    if (b.tape_count > 0) window = b.window;
    const std::uint32_t last = b.first + b.count - 1;
    for (std::uint32_t at = b.first; at <= last; at += points_per_job) {
      jobs.push_back({b.tape_begin, b.tape_count, at, last});
      windows.push_back(window);
    }
  }
  const std::vector<JobRun> runs =
      runs_of(jobs, windows, device_, [&](const PointJob& job) { return std::uint64_t{job[1]} * points_per_job; });
  const std::span sorted(reinterpret_cast<const float*>(slab.sorted.get()), 4 * count);
  Session& session = slab.session;
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const job_buffer, session.lend(std::span(jobs)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const points, session.input(sorted));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const results, session.output(out));
  const KernelKind kind = KernelKind::of(scene.tape());
  ISOFIELD_RETURN_IF_ERROR(record_runs(session, runs, cancelled, [&](const JobRun& run) -> absl::Status {
    const std::array constants{static_cast<std::uint32_t>(run.first),
                               static_cast<std::uint32_t>(run.first + run.count - 1),
                               static_cast<std::uint32_t>(std::countr_zero(points_per_job))};
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel,
                              kernels_.get(points_shader(layout, true), tapes.kind(kind, run.window)));
    return session.commands().dispatch(kernel,
                                       tapes.bindings(run.window, {{binding::sorted_points::kJobs, job_buffer},
                                                                   {binding::sorted_points::kPoints, points},
                                                                   {binding::points::kResults, results}}),
                                       constants, (run.count + jobs_per_group - 1) / jobs_per_group);
  }));
  return session.download(*results, out);
}

template <class Dispatch>
absl::Status FieldEvaluator::evaluate_in_order(std::size_t most, std::span<const float> xyz, ResultLayout layout,
                                               std::span<float> out, const Cancelled& cancelled, Submission submission,
                                               const Dispatch& dispatch) {
  const std::size_t count = xyz.size() / 3;
  most = std::min(most, kMostPoints);
  std::optional<Slab> running;
  for (std::size_t first = 0; first < count; first += most) {
    if (cancelled && cancelled()) return absl::CancelledError("the request was cancelled");
    const std::size_t part = std::min(most, count - first);
    ISOFIELD_ASSIGN_OR_RETURN(Slab slab, begin_slab(submission));
    Session& session = slab.session;
    const std::span<float> part_out = out.subspan(layout.numbers(first), layout.numbers(part));
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const points, session.input(xyz.subspan(3 * first, 3 * part)));
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const results, session.output(part_out));
    const auto last = static_cast<std::uint32_t>(part - 1);
    ISOFIELD_RETURN_IF_ERROR(dispatch(
        session, gpu::Commands::Bindings{{binding::points::kPoints, points}, {binding::points::kResults, results}},
        last, last / kPointsPerGroup + 1));
    ISOFIELD_RETURN_IF_ERROR(session.download(*results, part_out));
    ISOFIELD_RETURN_IF_ERROR(submit_after(running, std::move(slab)));
  }
  return finish(running);
}

absl::Status FieldEvaluator::evaluate_written(const gpu::SharedPipeline& kernel, const ResidentScene& scene,
                                              std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                                              const Cancelled& cancelled, Submission submission) {
  const std::size_t most =
      std::max<std::size_t>(profile().written_work / WrittenKernels::work_of(scene.tape()), kPointsPerGroup);
  return evaluate_in_order(
      most, xyz, layout, out, cancelled, std::move(submission),
      [&](Session& session, const gpu::Commands::Bindings& own, std::uint32_t last, std::uint32_t groups) {
        // The kernel reads no tape, so any buffer will do in the tape's place.
        return session.commands().dispatch(kernel, scene.bindings(*own.front().buffer, own), last, groups);
      });
}

absl::Status FieldEvaluator::evaluate_unsorted(const ResidentScene& scene, std::span<const float> xyz,
                                               ResultLayout layout, std::span<float> out, const Cancelled& cancelled,
                                               Submission submission) {
  TapeWindows tapes(device_, scene, scene.tape().code);
  std::uint32_t begin = 0;
  const auto length = static_cast<std::uint32_t>(scene.tape().code.size());
  const std::uint32_t window = tapes.add(begin, length);
  ISOFIELD_ASSIGN_OR_RETURN(
      const gpu::SharedPipeline kernel,
      kernels_.get(points_shader(layout, false), tapes.kind(KernelKind::of(scene.tape()), window)));
  bool is_uploaded = false;
  return evaluate_in_order(profile().submission_work / length, xyz, layout, out, cancelled, std::move(submission),
                           [&](Session& session, const gpu::Commands::Bindings& own, std::uint32_t last,
                               std::uint32_t groups) -> absl::Status {
                             if (!std::exchange(is_uploaded, true)) ISOFIELD_RETURN_IF_ERROR(tapes.upload(session));
                             return session.commands().dispatch(kernel, tapes.bindings(window, own),
                                                                std::array{last, begin, length}, groups);
                           });
}

absl::Status FieldEvaluator::evaluate_layers(const ResidentScene& scene, const blobtree::Lattice& lattice,
                                             std::uint32_t first_layer, ResultLayout layout, std::span<float> out,
                                             const Cancelled& cancelled) {
  const std::size_t layer = layout.numbers(std::size_t{lattice.cells[0]} * lattice.cells[1]);
  const auto layers = static_cast<std::uint32_t>(out.size() / layer);
  // The layers are culled as a lattice of their own. The device numbers points in the whole lattice, so that their
  // coordinates have the same bits as those of the whole.
  blobtree::CullRequest part{.lattice = lattice, .keep = blobtree::Keep::kSupport, .cancelled = cancelled};
  part.lattice.origin.z += lattice.spacing.z * first_layer;
  part.lattice.cells[2] = layers;
  ISOFIELD_ASSIGN_OR_RETURN(blobtree::BrickList bricks, blobtree::cull(scene.tape(), part));
  std::vector<Brick>& wanted = bricks.bricks;
  for (Brick& b : wanted) b.z += first_layer / blobtree::kBrickCells;
  if (wanted.empty()) {
    std::fill(out.begin(), out.end(), 0.0f);
    return absl::OkStatus();
  }
  const KernelKind kind = KernelKind::of(scene.tape());
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
  TapeWindows tapes(device_, scene, std::move(bricks.code));
  std::vector<std::uint32_t> windows;
  for (Brick& b : wanted) windows.push_back(tapes.add(b.tape_begin, b.tape_count));
  ISOFIELD_RETURN_IF_ERROR(tapes.upload(session));
  constexpr std::uint64_t kPoints = blobtree::kCellsPerBrick;
  const std::vector<JobRun> runs =
      runs_of(wanted, windows, device_, [&](const Brick& b) { return b.tape_count * kPoints; });
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const brick_buffer, session.lend(std::span(wanted)));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer* const results, session.lend_scratch(out.size_bytes()));
  session.commands().fill_zero(*results);
  session.commands().barrier();
  GridConstants constants{{static_cast<float>(lattice.origin.x), static_cast<float>(lattice.origin.y),
                           static_cast<float>(lattice.origin.z)},
                          {static_cast<float>(lattice.spacing.x), static_cast<float>(lattice.spacing.y),
                           static_cast<float>(lattice.spacing.z)},
                          {lattice.cells[0], lattice.cells[1], lattice.cells[2]},
                          0,
                          first_layer,
                          layers};
  const shaders::Spirv& shader = layout.has(Quantity::kGradient) ? shaders::kGridGradient : shaders::kGridValue;
  ISOFIELD_RETURN_IF_ERROR(record_runs(session, runs, cancelled, [&](const JobRun& run) -> absl::Status {
    constants.first_brick = static_cast<std::uint32_t>(run.first);
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels_.get(shader, tapes.kind(kind, run.window)));
    return session.commands().dispatch(
        kernel,
        tapes.bindings(run.window, {{binding::lattice::kBricks, brick_buffer}, {binding::points::kResults, results}}),
        constants, run.count);
  }));
  ISOFIELD_RETURN_IF_ERROR(session.download(*results, out));
  return session.run();
}

}  // namespace isofield::engine
