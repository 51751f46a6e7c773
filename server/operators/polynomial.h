// These functions fit polynomials to fixed functions and write them as GLSL. The profiles of the gradient blend are
// polynomials because on lavapipe a table look-up costs as much as 24 terms (each invocation loads its own cell). So
// are the two functions that powers are made of, because Vulkan promises too little of the driver's own
// (shaders/lib/powers.glsl).
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace isofield::operators {

// A Polynomial has the coefficients of c[0] + c[1] s + ..., where s goes through [-1, 1] across the interval.
using Polynomial = std::vector<double>;

// Interpolates a function at Chebyshev nodes. The error is within a small factor of that of the best polynomial of so
// many terms.
Polynomial fit_polynomial(const std::function<double(double)>& function, double low, double high, int terms);

// With this many terms in float32, values are within 2e-7 and slopes within 8e-6 (tests/unit).
inline constexpr int kProfileTerms = 24;
// Approximates phi on [1, 2]. On [0, 1] it follows from phi(x) = phi(2 - x) - 1 + x.
Polynomial phi_polynomial();
// Approximates the smooth silhouette's profile q on [0, 1].
Polynomial smooth_profile_polynomial();

// Approximates R in log2(1 + f) = log2(e) (f - f^2/2) + f^3 R(f), for 1 + f within [1/sqrt(2), sqrt(2)]. The error of
// f^3 R is at most 2e-9.
inline constexpr int kLogarithmTerms = 9;
Polynomial logarithm_polynomial();
// Approximates 2^y on [-1/2, 1/2] within 2e-9, and exactly at 0. The number of terms is odd, so that 0 is one of the
// nodes.
inline constexpr int kExponentialTerms = 7;
Polynomial exponential_polynomial();

// Returns the GLSL of `float name_value(float s)`. It sums by pairs, because in a chain of 24 dependent steps each
// would wait for the one before.
std::string value_glsl(const std::string& name, const Polynomial& polynomial);
// Returns the same, and the GLSL of `vec3 name(float s)`, which is the value with its first and second derivatives with
// respect to s.
std::string polynomial_glsl(const std::string& name, const Polynomial& polynomial);

}  // namespace isofield::operators
