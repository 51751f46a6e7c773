// The buffers of a resident scene: server/blobtree/parameter_layout.h.
#ifndef PARAMETERS_GLSL
#define PARAMETERS_GLSL

layout(std430, binding = 0) readonly buffer Leaves { vec4 leaves[]; };
layout(std430, binding = 1) readonly buffer Operations { vec4 operations[]; };
layout(std430, binding = 2) readonly buffer Tables { vec4 tables[]; };
// The first two once more, where they fit: on lavapipe a load from a storage buffer inside of a loop costs a loop over the
// lanes, a load from a uniform buffer does not (meshes of sums take 0.78 of the time).
layout(std140, binding = 16) uniform UniformLeaves { vec4 uniform_leaves[4096]; };
layout(std140, binding = 17) uniform UniformOperations { vec4 uniform_operations[4096]; };
layout(constant_id = 6) const uint UNIFORM_SET = 0u;  // 1: leaves, 2: operations

vec4 leaf_at(uint i) {
  if ((UNIFORM_SET & 1u) != 0u) return uniform_leaves[i];
  return leaves[i];
}
vec4 operation_at(uint i) {
  if ((UNIFORM_SET & 2u) != 0u) return uniform_operations[i];
  return operations[i];
}

layout(std430, binding = 3) readonly buffer Tape { uvec4 tape[]; };

#endif
