// The functions of one variable that gradient blends are made of: phi, silhouettes and opening functions. Fixed
// functions are polynomials (server/operators/polynomial.h). Functions that a scene chooses are tables of piecewise
// cubics (server/operators/profile_table.h), looked up in float32 because hardware filters have weights of only 8 bits.
#ifndef PROFILES_GLSL
#define PROFILES_GLSL

#include "angles.glsl"
#include "parameters.glsl"
#include "polynomials.glsl"  // written at build time

// The functions below mirror server/operators/profile_table.h.

// Returns the value, first and second derivative of a table's function at the place x, counted in cells.
vec3 profile(uint table, int cells, float x) {
  float place = clamp(x, 0.0, float(cells));
  int cell = min(int(place), cells - 1);
  float s = place - float(cell);
  vec4 c = tables[table + uint(cell)];
  float value = c.x + s * (c.y + s * (c.z + s * c.w));
  float slope = c.y + s * (2.0 * c.z + s * (3.0 * c.w));
  return vec3(value, slope, 2.0 * c.z + 6.0 * s * c.w);
}

// Returns phi of [G] eq. 20 for x within [0, 2], with its first and second derivatives. The lower half mirrors the
// upper: phi(x) = phi(2 - x) - 1 + x.
vec3 phi(float x) {
  float at = clamp(x, 0.0, 2.0);
  bool is_lower = at < 1.0;
  vec3 p = phi_upper(2.0 * (is_lower ? 2.0 - at : at) - 3.0);
  return vec3(is_lower ? p.x - 1.0 + at : p.x, is_lower ? 1.0 - 2.0 * p.y : 2.0 * p.y, 4.0 * p.z);
}

// Stands in place of a table's number for the smooth silhouette, which is a polynomial.
const uint SMOOTH_SILHOUETTE = 0xffffffffu;

// Returns the grading of a silhouette's cells: e^2 of Grading in server/operators/profile_table.h, then n and 1 + n e,
// in cells. The caller computes it once, outside the loop of Newton's method.
vec3 silhouette_grading(uint table) {
  if (table == SMOOTH_SILHOUETTE) return vec3(0.0);
  float e = tables[table].x;
  float e2 = e * e, n = sqrt(e2 + 1.0) + e;
  return vec3(e2, n * float(SILHOUETTE_CELLS), (1.0 + n * e) * float(SILHOUETTE_CELLS));
}

// Returns the silhouette's profile q(u) for u within [0, 1], with its first and second derivatives; exactly (1, 0, 0)
// at 0. The caller passes w = 1 - u, which it can compute without cancellation: beside a fold q depends on the square
// root of w.
vec3 silhouette_profile(uint table, vec3 grading, float u, float w) {
  vec3 q;
  if (table == SMOOTH_SILHOUETTE) {
    q = smooth_profile(2.0 * u - 1.0) * vec3(1.0, 2.0, 4.0);
  } else {
    float root = sqrt(grading.x + w);
    vec3 p = profile(table + 1u, SILHOUETTE_CELLS, grading.z - grading.y * root);
    float inverse = 1.0 / max(root, 1e-4);  // at the fold of the strongest bulge the slope is infinite
    float z_u = 0.5 * grading.y * inverse;
    q = vec3(p.x, p.y * z_u, z_u * (p.z * z_u + 0.5 * p.y * inverse * inverse));
  }
  return u > 0.0 ? q : vec3(1.0, 0.0, 0.0);
}

// Returns the table for the half of a silhouette on the side of the greater field. `silhouette` is the number in a
// scene's record, whose bit 30 marks a silhouette with two different halves.
uint silhouette_half(uint silhouette, float f1, float f2) {
  uint second = (silhouette >> 30u & 1u) != 0u && f1 < f2 ? uint(SILHOUETTE_CELLS + 1) : 0u;
  return (silhouette & 0x3fffffffu) + second;
}

// The places in an opening's ramps begin and end with these numbers, as server/operators/profile_table.h says.
const float FIRST_PLACE = 0.0625, LAST_PLACE = 0.99999994;
const uint RAMP_DIGITS = 1u << 25u;  // floatBitsToUint(1.0) - floatBitsToUint(FIRST_PLACE)

// Returns how far alpha lies beyond a sample, in steps between samples.
float beyond_sample(vec4 head, float number, float alpha) {
  precise float beyond = (alpha - number * head.x) - number * head.y;
  return beyond * head.z;
}

// Returns tan(theta) of an opening function and its derivative by alpha, for alpha within [0, pi], from opening_table()
// of server/operators/profile_table.h. The leading bits of a place are the number of its cell. The start of a cell is
// an exact float, so that the distance from it keeps all of its digits.
vec2 opening_tangent(uint table, float alpha) {
  vec4 head = tables[table];
  float from = alpha - head.x;
  bool is_left = from < 0.0;
  float per_unit = is_left ? -head.y : head.z;
  float place = min(from * per_unit + FIRST_PLACE, LAST_PLACE);
  uint digits = floatBitsToUint(place), shift = floatBitsToUint(head.w);
  float s = place - uintBitsToFloat(digits & 0xffffffffu << shift);
  uint cell = digits - floatBitsToUint(FIRST_PLACE) + (is_left ? RAMP_DIGITS : 0u) >> shift;
  bool is_sampled = has_sampled_openings() && head.w < 0.0;
  if (is_sampled) {
    // The rounding of alpha / step may miss the cell by up to a thousandth of a cell, and the second derivative may
    // jump between cells. So the cell's number is corrected with the exact distance.
    float number = floor(alpha * head.z);
    number = clamp(number + floor(beyond_sample(head, number, alpha)), 0.0, -1.0 - head.w);
    per_unit = head.z;
    s = beyond_sample(head, number, alpha);
    cell = uint(number);
  }
  vec4 c = tables[table + 1u + cell];
  vec2 t = vec2(c.x + s * (c.y + s * (c.z + s * c.w)), per_unit * (c.y + s * (2.0 * c.z + s * (3.0 * c.w))));
  if (is_sampled) {
    t.x = tangent(t.x);
    t.y *= 1.0 + t.x * t.x;
  }
  t.x = max(t.x, 0.0);  // the cubics of the steepest openings undershoot by 1e-8
  return t;
}

#endif
