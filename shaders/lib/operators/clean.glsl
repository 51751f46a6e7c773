// Barthe's clean union, [G] eqs. 9 and 10. Mirrors server/operators/clean.h.
#ifndef CLEAN_GLSL
#define CLEAN_GLSL

#include "joining.glsl"
#include "steering.glsl"

// The centre k of an arc of the union's level curve of value c, with its slope k_c = dk/dc, which Newton's method
// needs.
struct Centre {
  Dual k, k_c;
};
Centre clean_union_centre(Dual c) {
  Dual k = square_root(0.5 * c);
  bool is_low = value_of(c) <= 0.5;
  return Centre(select_dual(k, 2.0 * times(c, c), is_low),
                select_dual(0.25 * reciprocal(select_dual(k, dual(1.0), value_of(k) <= 0.0)), 4.0 * c, is_low));
}

// Returns the clean union by Newton's method from the maximum, where the slope is between 1 and 2. On the arcs beside
// the sharp edge it needs up to six steps. Lengths are measured in units of the greater field, so that no square
// underflows.
Binary clean_union(Dual f1, Dual f2) {
  bool swap = value_of(f1) < value_of(f2);
  Dual hi = select_dual(f1, f2, swap), lo = select_dual(f2, f1, swap);
  float top = value_of(hi), low = value_of(lo);
  float centre = value_of(clean_union_centre(hi).k);
  // The arcs have no radius at the sharp edge, so the maximum is taken there.
  bool is_max = low <= centre || low <= 0.0 || top - centre <= 1e-6 * top;
  float unit = 1.0 / max(top, 1e-37);
  float c = top;
  // The arc ends where the centre meets the lesser field; beyond that the equation has a false root.
  float limit = max(low < 0.5 ? sqrt(0.5 * max(low, 0.0)) : 2.0 * low * low, top);
  for (int step = 0; step < 7; ++step) {
    Centre at = clean_union_centre(dual(c));
    float k = value_of(at.k);
    float a = max((top - k) * unit, 1e-12), b = max((low - k) * unit, 0.0);
    float m = sqrt(a * a + b * b);
    float slope = 1.0 - value_of(at.k_c) * (1.0 - (a + b) / m);
    c = clamp(c - (c - k - m * top) / slope, top, limit);
  }
  // The first pass, a step in duals, gives the derivatives of the root; the second gives those of the partials.
  Dual root = dual(c), a, b, m, slope;
  for (int pass = 0; pass < 2; ++pass) {
    Centre at = clean_union_centre(root);
    a = unit * (hi - at.k);
    b = unit * (lo - at.k);
    Dual square = times(a, a) + times(b, b);
    m = square_root(select_dual(square, dual(1.0), value_of(square) <= 1e-24));
    slope = dual(1.0) - times(at.k_c, dual(1.0) - over(a + b, m));
    if (pass == 0) root = root - (root - at.k - top * m) * (1.0 / value_of(slope));
  }
  Dual inverse = reciprocal(times(m, slope));
  Binary r = Binary(root, times(a, inverse), times(b, inverse));
  r = select_binary(r, Binary(hi, dual(1.0), dual(0.0)), is_max);
  return select_binary(r, exchanged(r), swap);
}

Field unite_clean(Field a, Field b, uint record, Angle angle) {
  return join_positive(a, b, clean_union(dual_of(a), dual_of(b)));
}

// The clean union is sharp on the surface, and smooth elsewhere.
bool makes_seams_clean(uint record) { return true; }

#endif
