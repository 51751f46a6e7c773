// Pasko's blend, [G] eq. 5, and the union of R-functions, eq. 8, which is the same with a0 = 0. Mirrors
// server/operators/{pasko,r_union}.h.
#ifndef PASKO_GLSL
#define PASKO_GLSL

#include "joining.glsl"
#include "steering.glsl"

const float FAR = 1e8;  // in units of a1 or a2

// Returns the blend. `a` holds a0, 1 / a1^2 and 1 / a2^2.
Binary pasko_blend(Dual x1, Dual x2, vec3 a) {
  // The fields, which are at most MOST_FIELD, are scaled so that no square overflows or underflows.
  float size = max(max(abs(value_of(x1)), abs(value_of(x2))), 1e-30);
  Dual u1 = x1 * (1.0 / size), u2 = x2 * (1.0 / size);
  Dual r = square_root(times(u1, u1) + times(u2, u2));
  bool is_corner = value_of(r) < 0.5;  // both 0
  Dual inverse = select_dual(reciprocal(select_dual(r, dual(1.0), is_corner)), dual(0.0), is_corner);
  // Beyond FAR nothing is left of the displacement, and squares would overflow, so the arguments are clamped.
  float i1 = sqrt(a.y), i2 = sqrt(a.z);
  Dual t1 = i1 * x1, t2 = i2 * x2;
  t1 = select_dual(t1, dual(FAR), abs(value_of(t1)) > FAR);
  t2 = select_dual(t2, dual(FAR), abs(value_of(t2)) > FAR);
  Dual w = reciprocal(dual(1.0) + times(t1, t1) + times(t2, t2));
  Dual fall = 2.0 * a.x * times(w, w);
  return Binary(x1 + x2 - size * r + a.x * w, dual(1.0) - times(u1, inverse) - i1 * times(fall, t1),
                dual(1.0) - times(u2, inverse) - i2 * times(fall, t2));
}

Field unite_pasko(Field a, Field b, uint record, Angle angle) {
  return join_signed(a, b, pasko_blend(dual_of(a), dual_of(b), operation_at(record).xyz));
}

// The union of R-functions is sharp on the surface, and smooth elsewhere.
bool makes_seams_pasko(uint record) { return operation_at(record).x == 0.0; }

#endif
