#include "operators/polynomial.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "operators/silhouette.h"

namespace isofield::operators {
namespace {

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(static_cast<double>(k) * p[k]);
  return d;
}

std::string literal(double x) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9e", x);
  return text;
}

// Writes the sum by Estrin's scheme: c0 + c1 s, c2 + c3 s, ... are joined by s^2, those by s^4, and so on.
std::string sum_by_pairs(const std::string& name, const Polynomial& p) {
  std::string code = "float " + name + "(float s) {\n";
  std::vector<std::string> sums;
  for (const double c : p) sums.push_back(literal(c));
  std::string power = "s";
  for (int level = 0; sums.size() > 1; ++level) {
    const std::string suffix = std::to_string(level);
    if (level > 0) {
      code += "  float s" + suffix + " = " + power + " * " + power + ";\n";
      power = "s" + suffix;
    }
    std::vector<std::string> next;
    for (std::size_t i = 0; i < sums.size(); i += 2) {
      if (i + 1 == sums.size()) {
        next.push_back(sums[i]);
        break;
      }
      next.push_back("a" + suffix + "_" + std::to_string(i / 2));
      code += "  float " + next.back() + " = " + sums[i] + " + " + sums[i + 1] + " * " + power + ";\n";
    }
    sums = std::move(next);
  }
  return code + "  return " + sums[0] + ";\n}\n";
}

}  // namespace

Polynomial fit_polynomial(const std::function<double(double)>& function, double low, double high, int terms) {
  const auto n = static_cast<std::size_t>(terms);
  constexpr double kPi = std::numbers::pi;
  const auto angle = [&](std::size_t k) { return kPi * (static_cast<double>(k) + 0.5) / terms; };
  std::vector<double> samples;
  for (std::size_t k = 0; k < n; ++k)
    samples.push_back(function(low + (high - low) * (0.5 + 0.5 * std::cos(angle(k)))));
  // Each Chebyshev coefficient is spread over the powers of s by T_j = 2 s T_(j-1) - T_(j-2).
  Polynomial result(n, 0), before(n, 0), current(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    Polynomial next(n, 0);
    if (j == 0) next[0] = 1;
    if (j == 1) next[1] = 1;
    if (j > 1) {
      for (std::size_t k = 0; k < n; ++k) next[k] = (k > 0 ? 2 * current[k - 1] : 0) - before[k];
    }
    before = std::move(current);
    current = std::move(next);
    double coefficient = 0;
    for (std::size_t k = 0; k < n; ++k) coefficient += samples[k] * std::cos(static_cast<double>(j) * angle(k));
    coefficient *= (j == 0 ? 1.0 : 2.0) / terms;
    for (std::size_t k = 0; k < n; ++k) result[k] += coefficient * current[k];
  }
  return result;
}

Polynomial phi_polynomial() {
  return fit_polynomial([](double x) { return phi(x).v; }, 1, 2, kProfileTerms);
}

Polynomial smooth_profile_polynomial() {
  return fit_polynomial([](double u) { return Silhouette{}.profile(u).v; }, 0, 1, kProfileTerms);
}

Polynomial logarithm_polynomial() {
  const auto rest = [](double f) {
    if (std::abs(f) > 0.05) return (std::log1p(f) - f + 0.5 * f * f) / (f * f * f) * std::numbers::log2e;
    double sum = 0;  // the series, where the difference would cancel
    for (int n = 14; n >= 3; --n) sum = 1.0 / n - f * sum;
    return sum * std::numbers::log2e;
  };
  return fit_polynomial(rest, std::numbers::sqrt2 / 2 - 1, std::numbers::sqrt2 - 1, kLogarithmTerms);
}

Polynomial exponential_polynomial() {
  return fit_polynomial([](double y) { return std::exp2(y); }, -0.5, 0.5, kExponentialTerms);
}

std::string value_glsl(const std::string& name, const Polynomial& polynomial) {
  return sum_by_pairs(name + "_value", polynomial);
}

std::string polynomial_glsl(const std::string& name, const Polynomial& polynomial) {
  const Polynomial slope = derivative(polynomial);
  return value_glsl(name, polynomial) + sum_by_pairs(name + "_slope", slope) +
         sum_by_pairs(name + "_bend", derivative(slope)) + "vec3 " + name + "(float s) { return vec3(" + name +
         "_value(s), " + name + "_slope(s), " + name + "_bend(s)); }\n";
}

}  // namespace isofield::operators
