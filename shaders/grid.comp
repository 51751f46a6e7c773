// Evaluates the field on a lattice. A workgroup takes one brick and writes into the dense array of the wanted layers.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "bricks.glsl"
#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;  // CELLS_PER_BRICK

layout(push_constant) uniform Constants {
  vec4 origin;
  vec4 spacing;
  uvec3 counts;       // points along x, y, z
  uint first_brick;
  uint first_layer;   // k of the array's first layer
  uint layers;
};

void main() {
  Brick b = brick(first_brick + gl_WorkGroupID.x);
  uint n = gl_LocalInvocationID.x;
  uvec3 i = b.at * BRICK_CELLS + uvec3(n % BRICK_CELLS, n / BRICK_CELLS % BRICK_CELLS, n / (BRICK_CELLS * BRICK_CELLS));
  Field a = evaluate(lattice_point(origin.xyz, spacing.xyz, i), b.tape_begin, b.tape_count);
  if (all(lessThan(i, counts)) && i.z >= first_layer && i.z - first_layer < layers) {
    write_result(((i.z - first_layer) * counts.y + i.y) * counts.x + i.x, a);
  }
}
