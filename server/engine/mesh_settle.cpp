#include "engine/mesh_settle.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/mesh_samples.h"
#include "engine/session.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// The parts of these bricks that hold such samples, as places of the parts in the slab.
absl::StatusOr<std::vector<std::uint32_t>> find_parts(gpu::Device& device, KernelCache& kernels,
                                                      MeshConstants constants, std::span<const std::uint32_t> bricks,
                                                      const Buffer& samples) {
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* kernel, kernels.get(shaders::kMeshNear));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  std::vector<std::uint32_t> is_near(kSampleParts * bricks.size());
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer brick_buffer, session.upload(bricks));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer near_buffer, session.scratch(4 * is_near.size()));
  constants.count = static_cast<std::uint32_t>(bricks.size());
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(*kernel, {{5, &brick_buffer}, {6, &samples}, {7, &near_buffer}},
                                                       constants, mesh_groups(is_near.size())));
  ISOFIELD_RETURN_IF_ERROR(session.download(near_buffer, std::span(is_near)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  std::vector<std::uint32_t> parts;
  for (std::uint32_t n = 0; n < is_near.size(); ++n) {
    if (is_near[n] != 0) parts.push_back(bricks[n / kSampleParts] * kSampleParts + n % kSampleParts);
  }
  return parts;
}

}  // namespace

void set_rounding(const MeshRounding& rounding, MeshConstants& constants) {
  constants.shift = static_cast<float>(rounding.shift);
  constants.near = static_cast<float>(rounding.near);
  constants.value_room = static_cast<float>(rounding.value);
  // From a lattice point to the one beside it the distance of a plane along two of the lattice's axes changes by a third
  // of the way or more.
  constants.slope_room = static_cast<float>(3 * rounding.length / rounding.shift);
  constants.just_inside = constants.iso + std::max(std::abs(constants.iso) * 0x1p-23f, 1e-30f);
}

// Kernels on lavapipe can't leave out what only a few invocations want, so what only few samples need is done by
// dispatches of its own.
absl::StatusOr<bool> settle_samples(gpu::Device& device, KernelCache& kernels, BrickTapes& tapes,
                                    MeshConstants constants, const Buffer& bricks, std::uint32_t first,
                                    std::span<const std::uint32_t> is_near, const Buffer& samples) {
  std::vector<std::uint32_t> near_bricks;
  for (std::uint32_t b = 0; b < is_near.size(); ++b) {
    if (is_near[b] != 0) near_bricks.push_back(b);
  }
  if (near_bricks.empty()) return false;
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> parts,
                            find_parts(device, kernels, constants, near_bricks, samples));
  BrickTapes::Jobs jobs;
  for (const std::uint32_t part : parts) {
    const std::uint32_t brick = first + part / kSampleParts;
    jobs[tapes.group_of(brick)].push_back({brick, part});
  }
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::Pipeline* settle, kernels.get(shaders::kMeshSettle));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer beside, session.scratch(samples.size()));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer part_buffer, session.upload(std::span(parts)));
  std::vector<Buffer> keep;
  keep.reserve(1);
  ISOFIELD_RETURN_IF_ERROR(tapes.run(session, shaders::kMeshSample, constants, jobs, kSamplePartsPerGroup,
                                     {{4, &bricks}, {6, &beside}}, keep));
  session.commands().barrier();
  constants.count = static_cast<std::uint32_t>(parts.size());
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
      *settle, {{5, &part_buffer}, {6, &samples}, {7, &beside}}, constants,
      (constants.count + kSamplePartsPerGroup - 1) / kSamplePartsPerGroup));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  return true;
}

}  // namespace isofield::engine
