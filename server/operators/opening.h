// Opening functions theta(alpha): how wide a gradient-based blend opens at the angle alpha between two gradients.
// Source: [G] Gourmel et al. 2013, eqs. 15 and 16, Table I.
#pragma once

#include <compare>

#include "operators/derivatives.h"
#include "operators/sampled_curve.h"

namespace isofield::operators {

// The least alpha1 - alpha0 and alpha2 - alpha1: float32 places an angle near pi within 1e-4 of such a ramp.
inline constexpr double kLeastRamp = 1e-3;

// Radians. 0 <= alpha0 < alpha1 < alpha2 <= pi, each at least kLeastRamp from the next; thetas within [0, pi/4]; w
// within [0.05, 20]. Or, where there are any, the samples of theta over [0, pi].
struct Opening {
  double alpha0, alpha1, alpha2;
  double theta0, theta1, theta2;
  double w0, w1;
  SampledCurve samples{};

  // theta and d theta / d alpha at alpha within [0, pi]; the second derivative is not needed and left 0.
  Curve theta(double alpha) const;
  // The angle where one of the gradients vanishes ([G] section 7).
  double theta_min() const;
  // The opening theta(pi - alpha), of gradients of which one is turned round.
  Opening turned() const;
  auto operator<=>(const Opening&) const = default;
};

Opening camel();
Opening organic();
Opening contact();

// The angle at which the blend with a second field begins at a point of the first one's surface, from the two fields'
// values there ([G] section 4): at most pi/4.
double picked_opening(double f1, double f2);

// kappa(x) of eq. 16 for x within [0, 1], with its first derivative.
Curve kappa(double x);

}  // namespace isofield::operators
