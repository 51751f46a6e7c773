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
    const double dr = right.d1 * h;
    table[i] = {static_cast<float>(left.v), static_cast<float>(dl), static_cast<float>(3 * rise - 2 * dl - dr),
                static_cast<float>(dl + dr - 2 * rise)};
    left = right;
  }
  return table;
}

}  // namespace

Grading Grading::of(const Silhouette& silhouette) {
  if (silhouette.kind != Silhouette::Kind::kBulge) return {1};
  // At x = 1 - d beside the fold w = (1 - K) d + K (2 - K) d^2.
  const double k = silhouette.k;
  return {std::min((1 - k) / (2 * std::sqrt(std::max(k * (2 - k), 1e-9))), 1.0)};
}

double Grading::n() const {
  return std::sqrt(e * e + 1) + e;
}
double Grading::w(double z) const {
  const double v = (1 - z) / n();
  return v * (2 * e + v);
}
double Grading::slope(double z) const {
  return 2 * (e + (1 - z) / n()) / n();
}

ProfileTable silhouette_table(const Silhouette& silhouette) {
  using Half = Silhouette::Half;
  const Grading grading = Grading::of(silhouette);
  ProfileTable table;
  for (const Half half : {Half::kFirst, Half::kSecond}) {
    if (half == Half::kSecond && silhouette.is_symmetric()) break;
    const ProfileTable cells = tabulate(kSilhouetteCells, 1, [&](double z) {
      const Curve q = silhouette.profile(1 - grading.w(z), half);
      double slope = q.d1 * grading.slope(z);
      // At the fold of a bulge q = 1 + K d.
      if (z >= 1 && silhouette.kind == Silhouette::Kind::kBulge && silhouette.k > 0.5) {
        slope = -std::sqrt(silhouette.k / (2 - silhouette.k)) / grading.n();
      }
      return Curve{q.v, slope, 0};
    });
    table.push_back({static_cast<float>(grading.e), 0, 0, 0});
    table.insert(table.end(), cells.begin(), cells.end());
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
  const std::vector<double>& x = curve.x();
  ProfileTable table;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double width = x[i + 1] - x[i];
    table.push_back({static_cast<float>(x[i]), static_cast<float>(1 / width), 0, 0});
    table.push_back(tabulate(1, width, [&](double at) { return curve.at(x[i] + at); })[0]);
  }
  return table;
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
