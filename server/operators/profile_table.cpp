#include "operators/profile_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace isofield::operators {
namespace {

// Returns the cubic through values and slopes at both ends of a cell, in an s that is `end` at the right one.
CubicCell hermite(const Curve& left, const Curve& right, double width, double end = 1) {
  const double rise = right.v - left.v, dl = left.d1 * width, dr = right.d1 * width;
  return {static_cast<float>(left.v), static_cast<float>(dl / end),
          static_cast<float>((3 * rise - 2 * dl - dr) / (end * end)),
          static_cast<float>((dl + dr - 2 * rise) / (end * end * end))};
}

ProfileTable tabulate(int cells, double range, const std::function<Curve(double)>& function) {
  ProfileTable table(cells);
  const double h = range / cells;
  Curve left = function(0);
  for (int i = 0; i < cells; ++i) {
    const Curve right = function(h * (i + 1));
    table[i] = hermite(left, right, h);
    left = right;
  }
  return table;
}

// Appends the cells of one ramp of an opening. `per_unit` is how much the place grows with alpha, and is negative on
// the left.
void append_ramp(const Opening& opening, float origin, double per_unit, int per_octave, ProfileTable& table) {
  const auto node = [&](double place) {
    const Curve theta = opening.theta(origin + (place - kFirstPlace) / per_unit);
    const double t = std::tan(theta.v);
    return Curve{t, (1 + t * t) * theta.d1 / per_unit, 0};
  };
  Curve left = node(kFirstPlace);
  for (double octave = kFirstPlace; octave < 1; octave *= 2) {
    const double width = octave / per_octave;
    for (int i = 0; i < per_octave; ++i) {
      const Curve right = node(octave + width * (i + 1));
      table.push_back(hermite(left, right, width, width));
      left = right;
    }
  }
}

ProfileTable sampled_opening_table(const SampledCurve& samples) {
  const auto cells = static_cast<int>(samples.x().size()) - 1;
  const double step = std::numbers::pi / cells;
  // The step has 12 binary digits, beside the 12 of a cell's number.
  int exponent = 0;
  const double digits = std::frexp(step, &exponent);
  const double rounded = std::ldexp(std::round(std::ldexp(digits, 12)), exponent - 12);
  ProfileTable table{{static_cast<float>(rounded), static_cast<float>(step - rounded), static_cast<float>(1 / step),
                      static_cast<float>(-cells)}};
  const ProfileTable cubics = tabulate(cells, std::numbers::pi, [&](double alpha) { return samples.at(alpha); });
  table.insert(table.end(), cubics.begin(), cubics.end());
  return table;
}

}  // namespace

Grading Grading::of(const Silhouette& silhouette) {
  if (silhouette.kind != Silhouette::Kind::kBulge) return {1};
  // At x = 1 - d, beside the fold, w = (1 - K) d + K (2 - K) d^2.
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
      // Beside the fold of a bulge, q = 1 + K d.
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

int cells_per_octave(const Opening& opening) {
  return std::min(opening.w0, opening.w1) >= 0.1 && std::max(opening.w0, opening.w1) <= 3 ? 128 : 256;
}

ProfileTable opening_table(const Opening& opening) {
  if (!opening.samples.empty()) return sampled_opening_table(opening.samples);
  const int per_octave = cells_per_octave(opening);
  const auto origin = static_cast<float>(opening.alpha1);
  const auto left = static_cast<float>((1 - kFirstPlace) / (opening.alpha1 - opening.alpha0));
  const auto right = static_cast<float>((1 - kFirstPlace) / (opening.alpha2 - opening.alpha1));
  const int shift = std::numeric_limits<float>::digits - std::bit_width(static_cast<unsigned>(per_octave));
  ProfileTable table{{origin, left, right, std::bit_cast<float>(shift)}};
  append_ramp(opening, origin, right, per_octave, table);
  append_ramp(opening, origin, -static_cast<double>(left), per_octave, table);
  return table;
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
  return bound * 1.02 + 1e-6;  // leaves room between samples
}

}  // namespace isofield::operators
