// Helpers of operators that take all their operands at once (super-elliptic blend, BTk).
#ifndef MANY_GLSL
#define MANY_GLSL

#include "joining.glsl"
#include "operators/conversions.glsl"

// An operator takes the operands whose bits are set in `mask`, since culling may have dropped others. x[] holds them
// with the last one first, so that x[0] belongs to the highest bit. Elements of x[] beyond these hold no operand.

// Returns the place of the record of the next operand of x[], and clears its bit in `mask`. Without a further operand
// `is_there` is false.
uint take_operand(inout uint mask, uint record, out bool is_there) {
  is_there = mask != 0u;
  uint bit = is_there ? uint(findMSB(mask)) : 0u;
  mask &= ~(1u << bit);
  return record + 1u + bit;
}

// Replaces the operands by their complements where the form needs these before the union.
void turn_operands(inout Field x[MAX_OPERANDS], uint mask, uint form) {
  for (uint j = 0u; j < ARITY; ++j) {
    bool is_there;
    uint bit = take_operand(mask, 0u, is_there) - 1u;
    if (form == FORM_INTERSECTION || bit == 0u) x[j] = linear(x[j], -1.0, 0.0);
  }
}

// The field of the result, from its value g and its partial derivatives, which are 0 where there is no operand.
Field join_operands(Field x[MAX_OPERANDS], Dual g, Dual partials[MAX_OPERANDS]) {
  Field r = zero_field();
  r.f = value_of(g);
#ifdef WITH_GRADIENT
  r.g = gradient_of(g);
#endif
  for (uint j = 0u; j < ARITY; ++j) {
    float w = value_of(partials[j]);
    r.d += w * x[j].d;
#ifdef WITH_GRADIENT
    if (is_steered()) r.j += w * x[j].j + outerProduct(x[j].d, gradient_of(partials[j]));
#endif
  }
  return bounded(r);
}

#endif
