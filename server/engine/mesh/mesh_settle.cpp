#include "engine/mesh/mesh_settle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/mesh/mesh_samples.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// Returns the octets of listed bricks that hold samples near the surface, as place in the list * kOctets + octet.
absl::StatusOr<std::vector<std::uint32_t>> find_octets(Session session, const Kernels& kernels, MeshConstants constants,
                                                       const Buffer& listed, const Buffer& samples) {
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kMeshNear));
  std::vector<std::uint32_t> is_near(std::size_t{kOctets} * constants.count);
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const near_octets, session.lend_scratch(4 * is_near.size()));
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel,
                                                       {{binding::mesh_near::kListed, &listed},
                                                        {binding::mesh_near::kSamples, &samples},
                                                        {binding::mesh_near::kNearOctets, near_octets}},
                                                       constants, mesh_groups(is_near.size())));
  ISOFIELD_RETURN_IF_ERROR(session.download(*near_octets, std::span(is_near)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  std::vector<std::uint32_t> octets;
  for (std::uint32_t n = 0; n < is_near.size(); ++n) {
    if (is_near[n] != 0) octets.push_back(n);
  }
  return octets;
}

}  // namespace

void set_rounding(const MeshRounding& rounding, MeshConstants& constants) {
  constants.shift = static_cast<float>(rounding.shift);
  constants.near = static_cast<float>(rounding.near);
  constants.value_room = static_cast<float>(rounding.value);
  // Along the way from a lattice point to the point beside it, the distance from a plane that is parallel to two axes
  // of the lattice changes by a third of the way or more.
  constants.slope_room = static_cast<float>(3 * rounding.length / rounding.shift);
  constants.just_inside = constants.iso + std::max(std::abs(constants.iso) * 0x1p-23f, 1e-30f);
}

absl::Status classify(Session& session, const Kernels& kernels, const MeshConstants& constants, const SampledSlab& slab,
                      const Buffer& near_bricks, const Buffer& listed) {
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kMeshClassify));
  return session.commands().dispatch(kernel,
                                     {{binding::mesh_classify::kSamples, &slab.samples},
                                      {binding::mesh_classify::kCases, &slab.cases},
                                      {binding::mesh_classify::kNearBricks, &near_bricks},
                                      {binding::mesh_classify::kListed, &listed}},
                                     constants,
                                     mesh_groups(std::uint64_t{constants.count} * blobtree::kCellsPerBrick / 4));
}

// Kernels on lavapipe cannot skip work that only a few invocations need, so the work that only few samples need has
// dispatches of its own.
absl::Status settle_samples(gpu::Device& device, const Kernels& kernels, BrickTapes& tapes, MeshConstants constants,
                            const Buffer& bricks, const SampledSlab& slab, std::span<const std::uint32_t> is_near) {
  std::vector<std::uint32_t> near_bricks;
  for (std::uint32_t b = 0; b < is_near.size(); ++b) {
    if (is_near[b] != 0) near_bricks.push_back(b);
  }
  if (near_bricks.empty()) return absl::OkStatus();
  constants.first = slab.first;
  constants.count = static_cast<std::uint32_t>(near_bricks.size());
  constants.flags |= kIsListed;
  ISOFIELD_ASSIGN_OR_RETURN(Session first, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer listed, first.upload(std::span(near_bricks)));
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> octets,
                            find_octets(std::move(first), kernels, constants, listed, slab.samples));
  BrickTapes::Jobs jobs;
  for (const std::uint32_t octet : octets) {
    const std::uint32_t brick = slab.first + near_bricks[octet / kOctets];
    jobs[tapes.kernel_of(brick)].push_back({brick, octet});
  }
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline settle, kernels.get(shaders::kMeshSettle));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const beside,
                            session.lend_scratch(sizeof(float) * kCornersPerBrick * near_bricks.size()));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const octet_list, session.lend(std::span(octets)));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const unused, session.lend_scratch(4 * is_near.size()));
  ISOFIELD_RETURN_IF_ERROR(tapes.run(session, shaders::kMeshSample, constants, jobs, kOctetsPerWorkgroup,
                                     {{binding::lattice::kBricks, &bricks}, {binding::mesh_sample::kSamples, beside}}));
  session.commands().barrier();
  MeshConstants of_octets = constants;
  of_octets.count = static_cast<std::uint32_t>(octets.size());
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(settle,
                                                       {{binding::mesh_settle::kOctets, octet_list},
                                                        {binding::mesh_settle::kSamples, &slab.samples},
                                                        {binding::mesh_settle::kBeside, beside},
                                                        {binding::mesh_settle::kListed, &listed}},
                                                       of_octets,
                                                       mesh_groups(std::uint64_t{of_octets.count} * kOctetCorners)));
  session.commands().barrier();
  ISOFIELD_RETURN_IF_ERROR(classify(session, kernels, constants, slab, *unused, listed));
  return session.run();
}

}  // namespace isofield::engine
