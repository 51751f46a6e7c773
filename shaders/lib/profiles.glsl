// Piecewise cubic functions of one variable: server/operators/profile_table.h. Looked up in float32 (hardware filters
// have weights of 8 bits).
#ifndef PROFILES_GLSL
#define PROFILES_GLSL

#include "parameters.glsl"

// Mirrors server/operators/profile_table.h and the order of server/blobtree/parameter_layout.cpp.
const uint PHI_TABLE = 0u;
const int PHI_CELLS = 128;
const int SILHOUETTE_CELLS = 256;
const int OPENING_CELLS = 256;

// Value, first and second derivative.
vec3 profile(uint table, int cells, float per_unit, float x) {
  float place = clamp(x * per_unit, 0.0, float(cells));
  int cell = min(int(place), cells - 1);
  float s = place - float(cell);
  vec4 c = tables[table + uint(cell)];
  float value = c.x + s * (c.y + s * (c.z + s * c.w));
  float slope = c.y + s * (2.0 * c.z + s * (3.0 * c.w));
  return vec3(value, slope * per_unit, (2.0 * c.z + 6.0 * s * c.w) * per_unit * per_unit);
}

// phi of [G] eq. 20, x within [0, 2].
vec3 phi(float x) { return profile(PHI_TABLE, PHI_CELLS, float(PHI_CELLS) / 2.0, x); }

// The silhouette's profile q(u), u within [0, 1].
vec3 silhouette_profile(uint table, float u) {
  return profile(table, SILHOUETTE_CELLS, float(SILHOUETTE_CELLS), u);
}

// tan(theta) of an opening function at alpha within [0, pi].
vec3 opening_tangent(uint table, float alpha) {
  vec3 t = profile(table, OPENING_CELLS, float(OPENING_CELLS) / 3.14159265358979, alpha);
  t.x = max(t.x, 0.0);  // the cubics of the steepest openings undershoot by 4e-4
  return t;
}

#endif
