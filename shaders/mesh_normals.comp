// Mesher, pass 10: computes unit outward normals from the field's gradient. A workgroup takes one brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "mesh_constants.glsl"
#define CELL_SIZE origin.w
#include "interpreter.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_NORMALS_STARTS) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = BINDING_MESH_NORMALS_POSITIONS) readonly buffer Positions { float positions[]; };
layout(std430, binding = BINDING_MESH_NORMALS_NORMALS) writeonly buffer Normals { float normals[]; };

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  Brick at = brick(b);
  uint end = starts[b + 1u].x;
  // All invocations of a subgroup stay in the loop, as mesh_vertices.comp explains: surplus ones repeat the last
  // vertex.
  for (uint own = starts[b].x + gl_LocalInvocationID.x; subgroupAny(own < end); own += gl_WorkGroupSize.x) {
    uint v = min(own, end - 1u);
    vec3 p = vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]);
    // The gradient is scaled by the cell first: in large units its square underflows.
    vec3 n = -inward() * origin.w * field_gradient(evaluate(p, at.tape_begin, at.tape_count));
    float length2 = dot(n, n);
    n = length2 > 1e-30 ? n * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
    normals[3u * v] = n.x;
    normals[3u * v + 1u] = n.y;
    normals[3u * v + 2u] = n.z;
  }
}
