// A sharp choice between two fields, which minima, maxima and differences are made of.
#ifndef SHARP_UNION_GLSL
#define SHARP_UNION_GLSL

#include "field.glsl"

#ifdef CELL_SIZE
#include "seams.glsl"
#endif

// Returns b if take_b, else a. In kernels that compute normals, it also evens out the seam between the two.
Field sharp_union(Field a, Field b, bool take_b) {
  Field r = select_field(a, b, take_b);
#ifdef CELL_SIZE
  even_seam(r, a, b, take_b ? 1.0 : 0.0, SHARP_SEAM);
#endif
  return r;
}

#endif
