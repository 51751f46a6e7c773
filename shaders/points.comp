// Evaluates the field at a batch of points with one tape. No branch surrounds the loads and stores of points, because
// on lavapipe that would make each of them a loop over the lanes.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_POINTS_POINTS) readonly buffer Points { float points[]; };

layout(push_constant) uniform Constants {
  uint last;
  uint tape_begin;
  uint tape_count;
};

void main() {
  uint place = min(gl_GlobalInvocationID.x, last);  // surplus invocations repeat the last point
  vec3 p = vec3(points[3u * place], points[3u * place + 1u], points[3u * place + 2u]);
  write_result(place, evaluate(p, tape_begin, tape_count));
}
