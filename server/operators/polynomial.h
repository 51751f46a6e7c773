// Fixed functions as polynomials. The profiles of the gradient blend, since on lavapipe a table look-up costs as much as
// 24 terms (each invocation loads its own cell), so that the blend's two profiles run 1.45 times as fast this way; and
// the two functions that powers are made of, since Vulkan promises too little of the driver's own
// (shaders/lib/powers.glsl).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace isofield::operators {

// c[0] + c[1] s + ... with s within [-1, 1] across the interval.
using Polynomial = std::vector<double>;

// Interpolates at Chebyshev nodes: within a small factor of the best polynomial of so many terms.
Polynomial fit_polynomial(const std::function<double(double)>& function, double low, double high, int terms);

// With 24 terms in float32: values within 2e-7, slopes within 8e-6 (tests/unit).
inline constexpr int kProfileTerms = 24;
// phi on [1, 2]; on [0, 1] it follows from phi(x) = phi(2 - x) - 1 + x.
Polynomial phi_polynomial();
// The smooth silhouette's profile q on [0, 1].
Polynomial smooth_profile_polynomial();

// R in log2(1 + f) = log2(e) (f - f^2/2) + f^3 R(f), for 1 + f within [1/sqrt(2), sqrt(2)]: f^3 R is within 2e-9.
inline constexpr int kLogarithmTerms = 9;
Polynomial logarithm_polynomial();
// 2^y on [-1/2, 1/2], exactly 1 at 0, within 2e-9. The number of terms is odd, so that 0 is one of the nodes.
inline constexpr int kExponentialTerms = 7;
Polynomial exponential_polynomial();

// GLSL of `float name_value(float s)`. Summed by pairs, since a chain of 24 dependent steps waits for itself.
std::string value_glsl(const std::string& name, const Polynomial& polynomial);
// The same, and of `vec3 name(float s)`: value, first and second derivative with respect to s.
std::string polynomial_glsl(const std::string& name, const Polynomial& polynomial);

}  // namespace isofield::operators
