// Opening is an opening function theta(alpha): how wide a gradient-based blend opens at the angle alpha between two
// gradients. Source: [G] Gourmel et al. 2013, eqs. 15 and 16, Table I.
#pragma once

#include <compare>

#include "operators/derivatives.h"
#include "operators/sampled_curve.h"

namespace isofield::operators {

// alpha1 - alpha0 and alpha2 - alpha1 are at least this, because float32 places an angle near pi within 1e-4 of such a
// ramp.
inline constexpr double kLeastRamp = 1e-3;

// The angles are in radians. 0 <= alpha0 < alpha1 < alpha2 <= pi, each at least kLeastRamp from the next. The thetas
// are within [0, pi/4], and w0 and w1 within [0.05, 20]. If there are samples, they replace the other members: they are
// samples of theta over [0, pi].
struct Opening {
  double alpha0, alpha1, alpha2;
  double theta0, theta1, theta2;
  double w0, w1;
  SampledCurve samples{};

  // Returns theta and d theta / d alpha at alpha within [0, pi]. The second derivative is not needed, and ramps leave
  // it 0.
  Curve theta(double alpha) const;
  // Returns the opening that is taken where one of the gradients vanishes ([G] section 7).
  double theta_min() const;
  // Returns the opening theta(pi - alpha), for gradients of which one is turned round.
  Opening turned() const;
  auto operator<=>(const Opening&) const = default;
};

Opening camel();
Opening organic();
Opening contact();

// Returns the angle at which the blend with a second field begins at a point of the first one's surface, from the two
// fields' values there ([G] section 4). It is at most pi/4.
double picked_opening(double f1, double f2);

// Returns kappa(x) of [G] eq. 16 for x within [0, 1], with its first derivative.
Curve kappa(double x);

}  // namespace isofield::operators
