// Minima and maxima: one of two fields.
#ifndef SHARP_UNION_GLSL
#define SHARP_UNION_GLSL

#include "field.glsl"

#ifdef CELL_SIZE
#include "seams.glsl"
#endif

// Returns b if take_b, else a. Where normals are made, it evens out the seam between the two.
Field sharp_union(Field a, Field b, bool take_b) {
  Field r = select_field(a, b, take_b);
#ifdef CELL_SIZE
  even_seam(r, a, b, take_b ? 1.0 : 0.0, SHARP_SEAM);
#endif
  return r;
}

#endif
