// Runs a tape at a point: the tape is the list of instructions that a scene is compiled to. The stack lies in named
// registers that are shifted on push and pop, which is far faster on lavapipe than a stack in an indexed array. An
// instruction combines a leaf with the operator that takes it.
#ifndef INTERPRETER_GLSL
#define INTERPRETER_GLSL

#include "instruction.glsl"
#include "leaves.glsl"  // written at build time

#define SHIFT_DOWN(n, above) if (STACK_DEPTH > n) s##n = above
#define FOR_EACH_REGISTER_UP                                                                                 \
  SHIFT_DOWN(15u, s14u); SHIFT_DOWN(14u, s13u); SHIFT_DOWN(13u, s12u); SHIFT_DOWN(12u, s11u);                 \
  SHIFT_DOWN(11u, s10u); SHIFT_DOWN(10u, s9u); SHIFT_DOWN(9u, s8u); SHIFT_DOWN(8u, s7u);                      \
  SHIFT_DOWN(7u, s6u); SHIFT_DOWN(6u, s5u); SHIFT_DOWN(5u, s4u); SHIFT_DOWN(4u, s3u);                         \
  SHIFT_DOWN(3u, s2u); SHIFT_DOWN(2u, s1u); SHIFT_DOWN(1u, s0u)
#define SHIFT_UP(n, below, next) if (STACK_DEPTH > next) s##n = below
#define FOR_EACH_REGISTER_DOWN                                                                               \
  SHIFT_UP(0u, s1u, 1u); SHIFT_UP(1u, s2u, 2u); SHIFT_UP(2u, s3u, 3u); SHIFT_UP(3u, s4u, 4u);                 \
  SHIFT_UP(4u, s5u, 5u); SHIFT_UP(5u, s6u, 6u); SHIFT_UP(6u, s7u, 7u); SHIFT_UP(7u, s8u, 8u);                 \
  SHIFT_UP(8u, s9u, 9u); SHIFT_UP(9u, s10u, 10u); SHIFT_UP(10u, s11u, 11u); SHIFT_UP(11u, s12u, 12u);         \
  SHIFT_UP(12u, s13u, 13u); SHIFT_UP(13u, s14u, 14u); SHIFT_UP(14u, s15u, 15u)

Field evaluate(vec3 point, uint begin, uint count) {
  vec3 p = within_reach(point);
  // The first instruction pushes a leaf. It stands before the loop, because on lavapipe the loop would run its whole
  // body for it, blends included.
  uvec4 start = instruction_at(begin);
  Field acc = leaf_field(p, start.x & 0xffu, start.y);
  Field s0u = acc, s1u = acc, s2u = acc, s3u = acc, s4u = acc, s5u = acc, s6u = acc, s7u = acc, s8u = acc, s9u = acc,
        s10u = acc, s11u = acc, s12u = acc, s13u = acc, s14u = acc, s15u = acc;
  uint len = TAPE_LENGTH > 0u ? TAPE_LENGTH : count;
  for (uint n = 1u; n < len; ++n) {
    uvec4 i = instruction_at(begin + n);
    uint operand = i.x & 0xffu, op = has_modes() ? i.x >> 8u & 0xffu : i.x >> 8u;
    uint mode = has_modes() ? i.x >> 16u : 0u;
    Field v = leaf_field(p, operand, i.y);
    if (STACK_DEPTH > 0u && HAS_OPERAND_POP && is_code(ONLY_OPERAND, operand, OPERAND_POP)) {
      v = acc;
      acc = s0u;
      FOR_EACH_REGISTER_DOWN;
    }
    if (STACK_DEPTH > 0u && op == OPERATOR_PUSH) {
      FOR_EACH_REGISTER_UP;
      s0u = acc;
    }
    Field r = apply_operator(acc, v, op, mode, i.z);
    if (is_of_many(op)) {
      // The last operand is the accumulator; the operands before it wait in the registers, the nearest first.
      Field x[MAX_OPERANDS] = Field[MAX_OPERANDS](acc, s0u, s1u, s2u, s3u, s4u, s5u, s6u, s7u, s8u, s9u, s10u, s11u,
                                                  s12u, s13u, s14u);
      r = apply_to_many(x, op, i.y, mode, i.z);
      for (int k = bitCount(i.y); k > 1; --k) {
        FOR_EACH_REGISTER_DOWN;
      }
    }
    acc = r;
  }
  return acc;
}

#endif
