// Declares the compiled entry points (kernels) of this folder as SPIR-V, for the code that makes Vulkan pipelines.
#pragma once

#include <cstdint>
#include <span>

namespace isofield::shaders {

using Spirv = std::span<const std::uint32_t>;

extern const Spirv kPointsValue, kPointsGradient, kSortedPointsValue, kSortedPointsGradient;
extern const Spirv kGridValue, kGridGradient;
extern const Spirv kMeshSample, kMeshShare, kMeshClassify, kMeshNear, kMeshSettle, kMeshConnect, kMeshList, kMeshQuads,
    kMeshQuadsSmooth, kMeshTriangles;
// A kernel in which one workgroup takes one brick. The workgroup handles the brick's vertices or quads in rounds, each
// of as many as it has invocations: 32 in the wide version, 8 in the narrow one. On lavapipe the narrow version is
// faster, because the subgroups of a workgroup run one after the other there, and idle ones take time too.
struct InRounds {
  Spirv wide, narrow;
};
extern const InRounds kMeshCrossings, kMeshPlace, kMeshPlaceSmooth, kMeshCreases, kMeshVertices, kMeshNormals;
extern const Spirv kOperatorEval;
// These fill volumes. The first four are operator_volume.comp, compiled for the smooth silhouette or one given by a
// table, and for the half of the rows with low or high f1; the last is sampled_volume.comp.
extern const Spirv kSmoothVolumeLow, kSmoothVolumeHigh, kTableVolumeLow, kTableVolumeHigh, kSampledVolume;
extern const Spirv kOperatorBlendProbe, kOperatorFirstProbe, kOperatorVolumeProbe;

}  // namespace isofield::shaders
