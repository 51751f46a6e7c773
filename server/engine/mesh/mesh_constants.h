// What every pass of the mesher is told. Mirrors shaders/lib/mesh_constants.glsl.
#pragma once

#include <array>
#include <cstdint>

namespace isofield::engine {

struct MeshConstants {
  float origin[3];
  float cell;
  std::uint32_t cells[4];
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  float iso;
  std::uint32_t flags;  // 1: capped, 2: a signed field, 4: of listed bricks
  float tolerance;
  float shift, near, value_room, slope_room, just_inside;  // engine/mesh/mesh_rounding.h
};

// First vertex and first quad of a brick, or its first fan and 0.
using MeshStart = std::array<std::uint32_t, 2>;

// Workgroups of 64 invocations.
constexpr std::uint32_t mesh_groups(std::uint64_t invocations) {
  return static_cast<std::uint32_t>((invocations + 63) / 64);
}

}  // namespace isofield::engine
