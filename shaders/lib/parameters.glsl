// Reads the buffers of a resident scene: the records of leaves and operations, the tables and the tape. Their layout is
// in server/blobtree/tape/parameter_layout.h.
#ifndef PARAMETERS_GLSL
#define PARAMETERS_GLSL

#extension GL_KHR_shader_subgroup_shuffle : require

#include "bindings.glsl"  // written at build time
#include "codes.glsl"     // written at build time
#include "sizes.glsl"     // written at build time

layout(std430, binding = BINDING_SCENE_LEAVES) readonly buffer Leaves { vec4 leaves[]; };
layout(std430, binding = BINDING_SCENE_OPERATIONS) readonly buffer Operations { vec4 operations[]; };
layout(std430, binding = BINDING_SCENE_TABLES) readonly buffer Tables { vec4 tables[]; };
layout(std430, binding = BINDING_SCENE_TAPE) readonly buffer Tape { uvec4 tape[]; };
// The leaves, the operations and the tape are also bound as uniform buffers: whole where they fit, otherwise in windows
// that fit (server/engine/residency/tape_windows.h).
layout(std140, binding = BINDING_SCENE_UNIFORM_LEAVES) uniform UniformLeaves { vec4 uniform_leaves[WINDOW_SIZE]; };
layout(std140, binding = BINDING_SCENE_UNIFORM_OPERATIONS) uniform UniformOperations {
  vec4 uniform_operations[WINDOW_SIZE];
};
layout(std140, binding = BINDING_SCENE_UNIFORM_TAPE) uniform UniformTape { uvec4 uniform_tape[WINDOW_SIZE]; };

// True if the invocations of a subgroup share their loads. On lavapipe a load from a storage buffer inside a loop is
// itself a loop over the lanes, and a load from a uniform buffer takes some 100 instructions a vec4, even if all lanes
// load the same. So with subgroups of 8 each lane loads one word of two vec4s, and gets the other words by shuffles,
// which take one instruction each. All invocations of the subgroup must be active then.
#define shares_loads() ((UNIFORM_SET & LOADS_ARE_SHARED) != 0u)

// Two consecutive vec4s of a record.
struct Pair {
  vec4 a, b;
};

uint shared_vec4() { return gl_SubgroupInvocationID >> 2u & 1u; }
uint shared_word() { return gl_SubgroupInvocationID & 3u; }
vec4 of_lanes(float word, uint from) {
  return vec4(subgroupShuffle(word, from), subgroupShuffle(word, from + 1u), subgroupShuffle(word, from + 2u),
              subgroupShuffle(word, from + 3u));
}

vec4 leaf_at(uint i) {
  if (shares_loads()) return of_lanes(uniform_leaves[i][shared_word()], 0u);
  if ((UNIFORM_SET & LEAVES_ARE_UNIFORM) != 0u) return uniform_leaves[i];
  return leaves[i];
}
Pair leaf_pair_at(uint i) {
  if (!shares_loads()) return Pair(leaf_at(i), leaf_at(i + 1u));
  float word = uniform_leaves[i + shared_vec4()][shared_word()];
  return Pair(of_lanes(word, 0u), of_lanes(word, 4u));
}
vec4 operation_at(uint i) {
  if (shares_loads()) return of_lanes(uniform_operations[i][shared_word()], 0u);
  if ((UNIFORM_SET & OPERATIONS_ARE_UNIFORM) != 0u) return uniform_operations[i];
  return operations[i];
}

uvec4 instruction_at(uint i) {
  if (shares_loads()) {
    uint word = uniform_tape[i][shared_word()];
    return uvec4(subgroupShuffle(word, 0u), subgroupShuffle(word, 1u), subgroupShuffle(word, 2u), 0u);
  }
  if ((UNIFORM_SET & TAPE_IS_UNIFORM) != 0u) return uniform_tape[i];
  return tape[i];
}

#endif
