// Smooths the normals of meshes beside seams. A seam is a curve along which a sharp union, or a blend narrower than a
// cell, makes the surface turn by less than pictures show as a crease. The lattice decides by accident on which side of
// a seam a vertex lies, so the gradient of that side alone would shade the seam as a ragged line.
//
// Kernels that compute a mesh's normals include this, and define CELL_SIZE.
#ifndef SEAMS_GLSL
#define SEAMS_GLSL

#include "field.glsl"

// Normals turn within this distance of a seam, in cells: triangles reach as far, and normals are linear over a
// triangle. The distance is shorter if no Jacobian of a steering direction tells how the sides bend, so that surfaces
// that touch keep their normals. Surfaces that may crease have their vertices on the seam.
#define SEAM_REACH (is_steered() ? 1.0 : 0.25)
// The largest turns for which two sides are shaded as one surface, as squares of chords. For sharp unions it is 25
// degrees, from where client/cli/mesh_files cuts creases open. For blends that are narrow only in relation to the cells
// it is 40 degrees, above which camel blends are wide.
const float SHARP_SEAM = 0.18738443, NARROW_SEAM = 0.46791111;
// The tangent of theta from which a gradient blend counts as a sharp union: kSharp of server/operators/steered.cpp.
const float SHARP_OPENING = 0.9656888;

// Makes the gradient of r, an operator's result, turn evenly from the gradient of a to that of b where they meet at a
// turn below `most`. `turned` is the part that the operator has turned already, within [0, 1]. Half of the turn is made
// on the seam, and the turn ends at SEAM_REACH. Where the operator itself turns less sharply, its gradient stays.
//
// The sides meet where their fields are equal. On the way from there along one side, the other recedes by y. The slope
// y' is the sine of the angle between the sides, and y'' is the curvature by which they bend apart. So the turn at the
// seam is sqrt(y'^2 - 2 y'' y), or 0 where the sides touch, and the distance from the seam is 2 y over the sum of both
// slopes.
void even_seam(inout Field r, Field a, Field b, float turned, float most) {
#ifdef WITH_GRADIENT
  // Gradients are scaled to one cell, because in large units their squares would underflow.
  vec3 g1 = CELL_SIZE * field_gradient(a), g2 = CELL_SIZE * field_gradient(b);
  float n1 = dot(g1, g1), n2 = dot(g2, g2);
  float inverse1 = inversesqrt(max(n1, 1e-30)), inverse2 = inversesqrt(max(n2, 1e-30));
  vec3 across = inverse2 * g2 - inverse1 * g1;
  float slope2 = max(dot(across, across), 1e-12), inverse_slope = inversesqrt(slope2);
  bool is_second = turned > 0.5;
  float y = abs(a.f - b.f) * (is_second ? inverse1 : inverse2);
  float turn2 = slope2;
  if (is_steered()) {
    vec3 along = CELL_SIZE * inverse_slope * across;
    float bend = inverse2 * dot(along, b.j * along) - inverse1 * dot(along, a.j * along);
    turn2 = slope2 - 2.0 * y * (b.f < a.f ? -bend : bend);
  }
  float turn = sqrt(max(turn2, 0.0)) * inverse_slope;  // in units of the slope here
  float distance = 2.0 * y * inverse_slope / (1.0 + turn);
  float even = min(0.5 * turn, 0.5) * (1.0 - distance / SEAM_REACH);
  bool is_seam = even > min(turned, 1.0 - turned) && turn2 < most && min(n1, n2) > 1e-24;
  // The gradient keeps the length of its side's gradient, and keeps what r has beside the two gradients, as where an
  // opening follows their angle.
  float rest = (is_second ? 1.0 - even : even) - turned;
  vec3 step = rest / (CELL_SIZE * (is_second ? inverse2 : inverse1)) * across;
  // The steering directions stay, because they decide the shape.
  r.g = is_seam ? r.g + step : r.g;
  r.d = is_seam && !is_steered() ? r.d + step : r.d;
#endif
}

// Returns `turned` for an operator whose partials are not known here.
float part_turned(Field r, Field a, Field b) {
  vec3 g1 = CELL_SIZE * field_gradient(a), g2 = CELL_SIZE * field_gradient(b), g = CELL_SIZE * field_gradient(r);
  vec3 from = inversesqrt(max(dot(g1, g1), 1e-30)) * g1;
  vec3 across = inversesqrt(max(dot(g2, g2), 1e-30)) * g2 - from;
  return clamp(dot(inversesqrt(max(dot(g, g), 1e-30)) * g - from, across) / max(dot(across, across), 1e-12), 0.0, 1.0);
}

#endif
