// Evaluates the field at a batch of points with one tape, which is written as GLSL (server/engine/points/tape_writer.h)
// and included as the function Field evaluate_tape(vec3 p). An invocation takes one point, and no branch surrounds the
// loads and stores of points: on lavapipe data that a kernel reads at places known to the compiler are read once for
// all invocations, and a loop or a branch costs more than the rest of a small tape.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "instruction.glsl"
#include "leaves.glsl"  // written at build time
#include "output.glsl"
#include "tape.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_POINTS_POINTS) readonly buffer Points { float points[]; };

layout(push_constant) uniform Constants { uint last; };

void main() {
  uint place = min(gl_GlobalInvocationID.x, last);  // surplus invocations repeat the last point
  vec3 p = vec3(points[3u * place], points[3u * place + 1u], points[3u * place + 2u]);
  write_result(place, evaluate_tape(within_reach(p)));
}
