// The buffers of a resident scene: server/blobtree/parameter_layout.h.
#ifndef PARAMETERS_GLSL
#define PARAMETERS_GLSL

layout(std430, binding = 0) readonly buffer Leaves { vec4 leaves[]; };
layout(std430, binding = 1) readonly buffer Operations { vec4 operations[]; };
layout(std430, binding = 2) readonly buffer Tables { vec4 tables[]; };
layout(std430, binding = 3) readonly buffer Tape { uvec4 tape[]; };

#endif
