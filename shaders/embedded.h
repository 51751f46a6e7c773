// The compiled entry points of this folder.
#pragma once

#include <cstdint>
#include <span>

namespace isofield::shaders {

using Spirv = std::span<const std::uint32_t>;

extern const Spirv kPointsValue, kPointsGradient;
extern const Spirv kGridValue, kGridGradient;
extern const Spirv kMeshSample, kMeshClassify, kMeshConnect, kMeshList, kMeshCrossings, kMeshPlace, kMeshCreases,
    kMeshVertices, kMeshNormals, kMeshQuads, kMeshTriangles;
extern const Spirv kOperatorEval;
// operator_volume.comp by silhouette and half; sampled_volume.comp.
extern const Spirv kSmoothVolumeLow, kSmoothVolumeHigh, kTableVolumeLow, kTableVolumeHigh, kSampledVolume;
extern const Spirv kOperatorBlendProbe, kOperatorVolumeProbe;

}  // namespace isofield::shaders
