// Applies an instruction's operator to its operands, both for the interpreter and for tapes that are written as GLSL.
#ifndef INSTRUCTION_GLSL
#define INSTRUCTION_GLSL

#include "forms.glsl"
#include "operators.glsl"  // written at build time
#include "steering.glsl"
#ifdef CELL_SIZE
#include "seams.glsl"
#endif

// Returns the result of an operator on the accumulator and the right operand v. For OPERATOR_PUSH and for operators of
// many operands it returns v.
Field apply_operator(Field acc, Field v, uint op, uint mode, uint record) {
  // `first` and `second` are the operands in their order; a and b are the same, or their complements, as the form
  // needs.
  Field r = v, a = acc, b = v, first = acc, second = v;
  if (has_modes()) {
    bool is_exchanged = (mode & MODE_EXCHANGED) != 0u;
    first = select_field(acc, v, is_exchanged);
    second = select_field(v, acc, is_exchanged);
    a = select_field(first, complement(first, mode), (mode & 3u) != FORM_UNION);
    b = select_field(second, complement(second, mode), (mode & 3u) == FORM_INTERSECTION);
  }
  Field a_in_frame = in_frame(a, record), b_in_frame = in_frame(b, record);
  if (op != OPERATOR_PUSH) {
    Angle angle = no_angle();
    if (may_follow_angle()) angle = angle_between(a_in_frame, b_in_frame);
    r = unite(a, b, op, record, angle);
#ifdef CELL_SIZE
    if (makes_seams(op, record)) even_seam(r, a, b, part_turned(r, a, b), SHARP_SEAM);
#endif
  }
  r = unite_steered(r, a, b, a_in_frame, b_in_frame, op, record);
  if (has_modes()) r = formed(r, first, second, mode);
  return convert(r, acc, op, record);
}

// Returns the result of an operator of many operands, which are in the order of many.glsl: x[0] is the last.
Field apply_to_many(Field x[MAX_OPERANDS], uint op, uint mask, uint mode, uint record) {
  uint form = mode & 3u;
  if (has_modes() && form != FORM_UNION) turn_operands(x, mask, form);
  Angle angle = no_angle();
  if (may_follow_angle()) angle = angle_between(in_frame(x[0], record), in_frame(x[1], record));
  Field r = unite_many(x, op, mask, record, angle);
#ifdef CELL_SIZE
  // Ranges that follow an angle almost vanish where the two operands are aligned, which leaves a seam there.
  if (may_follow_angle() && operation_at(record).y >= 0.0) {
    even_seam(r, x[0], x[1], part_turned(r, x[0], x[1]), SHARP_SEAM);
  }
#endif
  if (has_modes()) r = select_field(r, linear(r, -1.0, 0.0), form != FORM_UNION);
  return r;
}

#endif
