#include "engine/mesh/sample_pass.h"

#include <bit>
#include <span>
#include <utility>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/mesh/mesh_samples.h"
#include "engine/mesh/mesh_settle.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// Returns how many bricks from `first` on make a slab; at least one.
std::uint32_t slab_from(const PartOnDevice& part, std::uint32_t first) {
  const gpu::DeviceProfile& most = part.device.profile();
  std::uint64_t instructions = 0;
  std::uint32_t end = first;
  while (end < part.total() && end - first < most.slab_bricks &&
         (end == first || instructions < most.slab_instructions)) {
    instructions += part.list.bricks[end++].tape_count;
  }
  return end - first;
}

// Records the evaluation of the octets that are not copied from another brick of the slab.
absl::Status evaluate_octets(Session& session, PartOnDevice& part, const MeshSlab& slab, const SlabOctets& octets) {
  BrickTapes::Jobs jobs;
  for (std::uint32_t n = 0; n < slab.count; ++n) {
    std::vector<BrickTapes::Job>& own = jobs[part.tapes.kernel_of(slab.first + n)];
    for (std::uint32_t left = octets.evaluated[n]; left != 0; left &= left - 1) {
      own.push_back({slab.first + n, n * kOctets + static_cast<std::uint32_t>(std::countr_zero(left))});
    }
  }
  MeshConstants constants = part.constants;
  constants.shift = 0;
  return part.tapes.run(session, shaders::kMeshSample, constants, jobs, kOctetsPerWorkgroup,
                        {{binding::lattice::kBricks, &part.bricks}, {binding::mesh_sample::kSamples, &slab.samples}});
}

// Records the copies of the other octets.
absl::Status take_over_octets(Session& session, const PartOnDevice& part, const MeshSlab& slab,
                              const SlabOctets& octets) {
  if (octets.taken_over.empty()) return absl::OkStatus();
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, part.kernels.get(shaders::kMeshShare));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const list, session.lend(std::span(octets.taken_over)));
  MeshConstants constants = part.constants;
  constants.count = static_cast<std::uint32_t>(octets.taken_over.size());
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
      kernel, {{binding::mesh_share::kOctets, list}, {binding::mesh_share::kSamples, &slab.samples}}, constants,
      mesh_groups(std::uint64_t{constants.count} * kOctetCorners)));
  session.commands().barrier();
  return absl::OkStatus();
}

absl::StatusOr<MeshSlab> sample_slab(PartOnDevice& part, std::uint32_t first, const Buffer& cases) {
  MeshSlab slab{first, slab_from(part, first), {}};
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
  ISOFIELD_ASSIGN_OR_RETURN(slab.samples, session.scratch(sizeof(float) * kCornersPerBrick * slab.count));
  const SlabOctets octets = slab_octets(part.neighbours, slab.first, slab.count);
  ISOFIELD_RETURN_IF_ERROR(evaluate_octets(session, part, slab, octets));
  session.commands().barrier();
  ISOFIELD_RETURN_IF_ERROR(take_over_octets(session, part, slab, octets));
  std::vector<std::uint32_t> is_near(slab.count);
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const near_bricks, session.lend(std::span(is_near)));
  MeshConstants constants = part.constants;
  constants.first = slab.first;
  constants.count = slab.count;
  const SampledSlab sampled{slab.first, slab.samples, cases};
  ISOFIELD_RETURN_IF_ERROR(classify(session, part.kernels, constants, sampled, *near_bricks, *near_bricks));
  ISOFIELD_RETURN_IF_ERROR(session.download(*near_bricks, std::span(is_near)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  ISOFIELD_RETURN_IF_ERROR(
      settle_samples(part.device, part.kernels, part.tapes, part.constants, part.bricks, sampled, is_near));
  return slab;
}

}  // namespace

absl::StatusOr<PartSamples> sample_corners(PartOnDevice& part) {
  PartSamples samples;
  const std::uint32_t total = part.total();
  ISOFIELD_ASSIGN_OR_RETURN(
      samples.cases, Buffer::create(part.device, std::size_t{total} * blobtree::kCellsPerBrick, Buffer::Use::kDevice));
  for (std::uint32_t first = 0; first < total;) {
    ISOFIELD_RETURN_IF_ERROR(part.check(0.1 + 0.5 * first / total));
    ISOFIELD_ASSIGN_OR_RETURN(MeshSlab slab, sample_slab(part, first, samples.cases));
    first += slab.count;
    samples.slabs.push_back(std::move(slab));
  }
  return samples;
}

}  // namespace isofield::engine
