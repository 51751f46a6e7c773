// How an operator that is written as a union is applied as an intersection or a difference.
#ifndef FORMS_GLSL
#define FORMS_GLSL

#include "operators/conversions.glsl"

// What a form makes of its operands before the union of them, and of that after: modes of codes.glsl. Beside a positive
// complement, one that is negative is as good as 0.
Field complement(Field a, uint mode) {
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field c = linear(a, -1.0, is_signed ? 0.0 : 1.0);
  return select_field(c, zero_field(), !is_signed && c.f <= 0.0);
}

Field formed(Field r, Field first, Field second, uint mode) {
  uint form = mode & 3u;
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field turned = complement(r, mode);
  if (!is_signed) {
    bool is_intersection = form == FORM_INTERSECTION;
    // 0 is outside: of an intersection, and of what is left of 0. What is less 0 is clamped alone.
    bool is_zero = turned.f <= 0.0 || first.f <= 0.0 || (is_intersection && second.f <= 0.0);
    bool is_first = !is_intersection && second.f <= 0.0 && first.f < 1.0;
    turned = select_field(turned, first, is_first);
    // The union of complements is the greatest of them where one is not positive.
    bool is_least = is_intersection && min(first.f, second.f) >= 1.0;
    turned = select_field(turned, select_field(first, second, second.f < first.f), is_least);
    turned = select_field(turned, zero_field(), is_zero);
  }
  return select_field(r, turned, form != FORM_UNION);
}

#endif
