// Applies an operator whose formula is that of a union as an intersection or a difference, by duality.
#ifndef FORMS_GLSL
#define FORMS_GLSL

#include "operators/conversions.glsl"

// The complement of a field: 1 - f of a positive field and -f of a signed one (`mode` has the bits of codes.glsl). A
// negative complement of a positive field is replaced by 0, which gives the same union with a positive one.
Field complement(Field a, uint mode) {
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field c = linear(a, -1.0, is_signed ? 0.0 : 1.0);
  return select_field(c, zero_field(), !is_signed && c.f <= 0.0);
}

// Makes the result of a form from r, the union of the operands or their complements. `first` and `second` are the
// operands themselves.
Field formed(Field r, Field first, Field second, uint mode) {
  uint form = mode & 3u;
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field turned = complement(r, mode);
  if (!is_signed) {
    bool is_intersection = form == FORM_INTERSECTION;
    // The result is 0 where the first operand is 0, and for an intersection also where the second is. A difference from
    // which 0 is taken is the first operand, clamped to 1.
    bool is_zero = turned.f <= 0.0 || first.f <= 0.0 || (is_intersection && second.f <= 0.0);
    bool is_first = !is_intersection && second.f <= 0.0 && first.f < 1.0;
    turned = select_field(turned, first, is_first);
    // The union of complements is their maximum where one of them is not positive; so an intersection of fields above 1
    // is their minimum.
    bool is_least = is_intersection && min(first.f, second.f) >= 1.0;
    turned = select_field(turned, select_field(first, second, second.f < first.f), is_least);
    turned = select_field(turned, zero_field(), is_zero);
  }
  return select_field(r, turned, form != FORM_UNION);
}

#endif
