// gradient_blend() is the gradient-based composition operator g(f1, f2, theta) in double precision: [G] eqs. 17 to 24
// in the form of the project's operators note, section 2.1 (homogeneous smooth maximum, no volume).
#pragma once

#include "operators/derivatives.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// Boundary is the boundary k(f) of the blending region at t = tan(theta) ([G] eqs. 17 to 20), with the derivatives that
// g needs.
struct Boundary {
  double k = 0;
  double k_f = 0, k_ff = 0;  // with respect to f
  double k_t = 0, k_ft = 0;  // with respect to t, and to both
};
Boundary boundary(double f, double t);

// Blend is g with its first partials and those second partials that the derivative of (g_1, g_2) needs. The subscript t
// stands for derivatives with respect to theta (radians).
struct Blend {
  double g = 0;
  double g1 = 0, g2 = 0, gt = 0;
  double g11 = 0, g12 = 0, g22 = 0, g1t = 0, g2t = 0;
};

// Returns g for f1, f2 >= 0 (values above 1 are legal) and theta within [0, pi/4]. The identities g(f, 0) = f, g(0, f)
// = f and g(0, 0) = 0 hold exactly.
Blend gradient_blend(double f1, double f2, double theta, const Silhouette& silhouette);

}  // namespace isofield::operators
