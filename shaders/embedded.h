// The compiled entry points of this folder.
#pragma once

#include <cstdint>
#include <span>

namespace isofield::shaders {

using Spirv = std::span<const std::uint32_t>;

extern const Spirv kPointsValue, kPointsGradient;
extern const Spirv kGridValue, kGridGradient;
extern const Spirv kMeshSample, kMeshClassify, kMeshConnect, kMeshList, kMeshVertices, kMeshNormals, kMeshTriangles;
extern const Spirv kOperatorEval;

}  // namespace isofield::shaders
