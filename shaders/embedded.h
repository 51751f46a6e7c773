// The compiled entry points of this folder.
#pragma once

#include <cstdint>
#include <span>

namespace isofield::shaders {

using Spirv = std::span<const std::uint32_t>;

extern const Spirv kPointsValue, kPointsGradient, kSortedPointsValue, kSortedPointsGradient;
extern const Spirv kGridValue, kGridGradient;
extern const Spirv kMeshSample, kMeshShare, kMeshClassify, kMeshNear, kMeshSettle, kMeshConnect, kMeshList,
    kMeshQuads, kMeshQuadsSmooth, kMeshTriangles;
// A workgroup takes what a brick has in rounds of as many as it has invocations: 32, or 8. On lavapipe the subgroups of
// a workgroup run one after the other, and idle ones cost, too: with four of 8 a mesh of 1,000 spheres takes 1.1 times
// as long as with one.
struct InRounds {
  Spirv wide, narrow;
};
extern const InRounds kMeshCrossings, kMeshPlace, kMeshPlaceSmooth, kMeshCreases, kMeshVertices, kMeshNormals;
extern const Spirv kOperatorEval;
// operator_volume.comp by silhouette and half; sampled_volume.comp.
extern const Spirv kSmoothVolumeLow, kSmoothVolumeHigh, kTableVolumeLow, kTableVolumeHigh, kSampledVolume;
extern const Spirv kOperatorBlendProbe, kOperatorFirstProbe, kOperatorVolumeProbe;

}  // namespace isofield::shaders
