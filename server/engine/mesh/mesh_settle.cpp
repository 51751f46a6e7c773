#include "engine/mesh/mesh_settle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/status_macros.h"
#include "engine/mesh/mesh_samples.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// The parts of listed bricks that hold such samples: place in the list * kSampleParts + part.
absl::StatusOr<std::vector<std::uint32_t>> find_parts(Session session, const Kernels& kernels, MeshConstants constants,
                                                      const Buffer& listed, const Buffer& samples) {
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kMeshNear));
  std::vector<std::uint32_t> is_near(std::size_t{kSampleParts} * constants.count);
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer near_buffer, session.scratch(4 * is_near.size()));
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel, {{5, &listed}, {6, &samples}, {7, &near_buffer}},
                                                       constants, mesh_groups(is_near.size())));
  ISOFIELD_RETURN_IF_ERROR(session.download(near_buffer, std::span(is_near)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  std::vector<std::uint32_t> parts;
  for (std::uint32_t n = 0; n < is_near.size(); ++n) {
    if (is_near[n] != 0) parts.push_back(n);
  }
  return parts;
}

}  // namespace

void set_rounding(const MeshRounding& rounding, MeshConstants& constants) {
  constants.shift = static_cast<float>(rounding.shift);
  constants.near = static_cast<float>(rounding.near);
  constants.value_room = static_cast<float>(rounding.value);
  // From a lattice point to the one beside it the distance of a plane along two axes of the lattice changes by a third
  // of the way or more.
  constants.slope_room = static_cast<float>(3 * rounding.length / rounding.shift);
  constants.just_inside = constants.iso + std::max(std::abs(constants.iso) * 0x1p-23f, 1e-30f);
}

absl::Status classify(Session& session, const Kernels& kernels, const MeshConstants& constants, const SampledSlab& slab,
                      const Buffer& near_bricks, const Buffer& listed) {
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kMeshClassify));
  return session.commands().dispatch(kernel,
                                     {{5, &slab.samples}, {6, &slab.cases}, {7, &near_bricks}, {8, &listed}}, constants,
                                     mesh_groups(std::uint64_t{constants.count} * blobtree::kCellsPerBrick / 4));
}

// Kernels on lavapipe can't leave out what only a few invocations want, so what only few samples need is done by
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
  constants.flags |= 4;
  ISOFIELD_ASSIGN_OR_RETURN(Session first, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer listed, first.upload(std::span(near_bricks)));
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> parts,
                            find_parts(std::move(first), kernels, constants, listed, slab.samples));
  BrickTapes::Jobs jobs;
  for (const std::uint32_t part : parts) {
    const std::uint32_t brick = slab.first + near_bricks[part / kSampleParts];
    jobs[tapes.group_of(brick)].push_back({brick, part});
  }
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline settle, kernels.get(shaders::kMeshSettle));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  constexpr std::size_t kEdge = blobtree::kBrickCells + 1, kCorners = kEdge * kEdge * kEdge;
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer beside, session.scratch(sizeof(float) * kCorners * near_bricks.size()));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer part_buffer, session.upload(std::span(parts)));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer unused, session.scratch(4 * is_near.size()));
  std::vector<Buffer> keep;
  keep.reserve(1);
  ISOFIELD_RETURN_IF_ERROR(tapes.run(session, shaders::kMeshSample, constants, jobs, kSamplePartsPerGroup,
                                     {{4, &bricks}, {6, &beside}}, keep));
  session.commands().barrier();
  MeshConstants of_parts = constants;
  of_parts.count = static_cast<std::uint32_t>(parts.size());
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
      settle, {{5, &part_buffer}, {6, &slab.samples}, {7, &beside}, {8, &listed}}, of_parts,
      (of_parts.count + kSamplePartsPerGroup - 1) / kSamplePartsPerGroup));
  session.commands().barrier();
  ISOFIELD_RETURN_IF_ERROR(classify(session, kernels, constants, slab, unused, listed));
  return session.run();
}

}  // namespace isofield::engine
