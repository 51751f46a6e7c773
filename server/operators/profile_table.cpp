#include "operators/profile_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace isofield::operators {
namespace {

ProfileTable tabulate(int cells, double range, const std::function<Curve(double)>& function) {
  ProfileTable table(cells);
  const double h = range / cells;
  Curve left = function(0);
  for (int i = 0; i < cells; ++i) {
    const Curve right = function(h * (i + 1));
    const double rise = right.v - left.v, dl = left.d1 * h;
    double dr = right.d1 * h;
    // A function that ends (nearly) vertically, as a bulge of K = 1 does at its fold, ends in a parabola.
    if (i + 1 == cells && std::abs(dr) > 4 * std::abs(rise)) dr = 2 * rise - dl;
    table[i] = {static_cast<float>(left.v), static_cast<float>(dl), static_cast<float>(3 * rise - 2 * dl - dr),
                static_cast<float>(dl + dr - 2 * rise)};
    left = right;
  }
  return table;
}

}  // namespace

ProfileTable silhouette_table(const Silhouette& silhouette) {
  using Half = Silhouette::Half;
  const auto half = [&](Half h) {
    return tabulate(kSilhouetteCells, 1, [&](double u) { return silhouette.profile(u, h); });
  };
  ProfileTable table = half(Half::kFirst);
  if (!silhouette.is_symmetric()) {
    const ProfileTable second = half(Half::kSecond);
    table.insert(table.end(), second.begin(), second.end());
  }
  return table;
}

ProfileTable opening_table(const Opening& opening) {
  return tabulate(kOpeningCells, std::numbers::pi, [&](double alpha) {
    const Curve theta = opening.theta(alpha);
    const double t = std::tan(theta.v);
    return Curve{t, (1 + t * t) * theta.d1, 0};
  });
}

ProfileTable curve_table(const SampledCurve& curve) {
  const double low = curve.x().front();
  return tabulate(kCurveCells, curve.x().back() - low, [&](double x) { return curve.at(low + x); });
}

double silhouette_bound(const Silhouette& silhouette) {
  double bound = 0;
  constexpr int kSamples = 256;
  for (int i = 1; i <= kSamples; ++i) {
    const double u = static_cast<double>(i) / kSamples;
    for (const auto half : {Silhouette::Half::kFirst, Silhouette::Half::kSecond}) {
      bound = std::max(bound, (silhouette.profile(u, half).v - 1) / u);
    }
  }
  return bound * 1.02 + 1e-6;  // between samples
}

}  // namespace isofield::operators
