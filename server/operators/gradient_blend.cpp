#include "operators/gradient_blend.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "operators/root.h"

namespace isofield::operators {
namespace {

// Returns q of M(a, b) = a q(b / a), for a > 0 and b of any sign. If b <= 0, the point is outside the blending region,
// and M = a.
Curve clamped_profile(const Silhouette& s, Silhouette::Half half, double a, double b) {
  return b > 0 ? s.profile(std::min(b / a, 1.0), half) : Curve{1, 0, 0};
}

}  // namespace

Boundary boundary(double f, double t) {
  if (f >= 0.5) return {t / 2, 0, 0, 0.5, 0};
  // k = (8 t / (1 + t)^2) lambda^2
  Curve lambda{f, 1, 0};               // derivatives by f
  double lambda_t = 0, lambda_ft = 0;  // derivatives by t
  if (f > t / 2) {
    const double x = 2 * (2 * f - t) / (1 - t);
    const double x_t = 2 * (2 * f - 1) / ((1 - t) * (1 - t));
    const Curve p = phi(x);
    lambda = {(1 - t) / 4 * p.v + t / 2, p.d1, p.d2 * 4 / (1 - t)};
    lambda_t = -p.v / 4 + 0.5 + (1 - t) / 4 * p.d1 * x_t;
    lambda_ft = p.d2 * x_t;
  }
  const double c = 8 * t / ((1 + t) * (1 + t));
  const double c_t = 8 * (1 - t) / ((1 + t) * (1 + t) * (1 + t));
  const double l = lambda.v;
  return {c * l * l, 2 * c * l * lambda.d1, 2 * c * (lambda.d1 * lambda.d1 + l * lambda.d2),
          c_t * l * l + 2 * c * l * lambda_t, 2 * c_t * l * lambda.d1 + 2 * c * (lambda_t * lambda.d1 + l * lambda_ft)};
}

namespace {

// Returns the blend for f1 >= f2.
Blend ordered_blend(double f1, double f2, double theta, const Silhouette& silhouette, Silhouette::Half half) {
  const double t = std::tan(theta);
  const Boundary at_max = boundary(f1, t);
  if (f2 <= 0 || f2 <= at_max.k) return {f1, 1, 0, 0, 0, 0, 0, 0, 0};

  // F(C) = C - k - M(f1 - k, f2 - k) increases on [f1, k^-1(f2)]. With M = a for b <= 0 it is positive beyond, and it
  // is positive at 2 f1, since q < 2.
  const double c = root_of(f1, 2 * f1, [&](double c) {
    const Boundary k = boundary(c, t);
    const double a = f1 - k.k, b = f2 - k.k;
    const Curve q = clamped_profile(silhouette, half, a, b);
    const double u = b > 0 ? std::min(b / a, 1.0) : 0;
    return std::pair{c - k.k - a * q.v, 1 - k.k_f * (1 - q.v - (1 - u) * q.d1)};
  });
  const Boundary k = boundary(c, t);
  const double a = f1 - k.k, b = f2 - k.k;
  const Curve q = clamped_profile(silhouette, half, a, b);
  const double u = std::clamp(b / a, 0.0, 1.0);
  const double m_a = q.v - u * q.d1, m_b = q.d1;
  const double rest = 1 - m_a - m_b;
  const double slope = 1 - k.k_f * rest;  // F'
  const double t_theta = 1 + t * t;

  Blend r;
  r.g = c;
  r.g1 = m_a / slope;
  r.g2 = m_b / slope;
  r.gt = k.k_t * t_theta * rest / slope;
  // Returns the total derivatives of (g1, g2) with respect to one of f1, f2, theta, by the implicit function theorem.
  const auto second = [&](double a_v, double b_v, double k_v, double kf_v) {
    const double u_v = ((b_v - k_v) - u * (a_v - k_v)) / a;
    const double ma_v = -u * q.d2 * u_v, mb_v = q.d2 * u_v;
    const double slope_v = -kf_v * rest + k.k_f * (ma_v + mb_v);
    return std::pair{(ma_v - r.g1 * slope_v) / slope, (mb_v - r.g2 * slope_v) / slope};
  };
  std::tie(r.g11, r.g12) = second(1, 0, k.k_f * r.g1, k.k_ff * r.g1);
  r.g22 = second(0, 1, k.k_f * r.g2, k.k_ff * r.g2).second;
  std::tie(r.g1t, r.g2t) = second(0, 0, k.k_f * r.gt + k.k_t * t_theta, k.k_ff * r.gt + k.k_ft * t_theta);
  return r;
}

}  // namespace

Blend gradient_blend(double f1, double f2, double theta, const Silhouette& silhouette) {
  if (f1 >= f2) return ordered_blend(f1, f2, theta, silhouette, Silhouette::Half::kFirst);
  Blend s = ordered_blend(f2, f1, theta, silhouette, Silhouette::Half::kSecond);
  std::swap(s.g1, s.g2);
  std::swap(s.g11, s.g22);
  std::swap(s.g1t, s.g2t);
  return s;
}

}  // namespace isofield::operators
