#include "operators/sampled_curve.h"

#include <algorithm>
#include <cmath>

namespace isofield::operators {

SampledCurve::SampledCurve(std::vector<double> x, std::vector<double> y) {
  const std::size_t n = x.size();
  std::vector<double> slope(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = (y[i] - y[i - 1]) / (x[i] - x[i - 1]), right = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    if (left * right <= 0) continue;  // an extremum is flat
    // The weighted harmonic mean keeps every piece monotone.
    const double wl = 2 * (x[i + 1] - x[i]) + (x[i] - x[i - 1]), wr = (x[i + 1] - x[i]) + 2 * (x[i] - x[i - 1]);
    slope[i] = (wl + wr) / (wl / left + wr / right);
  }
  samples_ = std::make_shared<const Samples>(Samples{std::move(x), std::move(y), std::move(slope)});
}

SampledCurve SampledCurve::even(double low, double high, std::vector<double> y) {
  std::vector<double> x(y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(x.size() - 1);
  }
  return {std::move(x), std::move(y)};
}

Curve SampledCurve::at(double at) const {
  const auto& [x, y, slope] = *samples_;
  if (!(at > x.front())) return {y.front(), 0, 0};
  if (at >= x.back()) return {y.back(), 0, 0};
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
  const double h = x[i + 1] - x[i], s = (at - x[i]) / h, rise = y[i + 1] - y[i];
  const double left = slope[i] * h, right = slope[i + 1] * h;
  const double c2 = 3 * rise - 2 * left - right, c3 = left + right - 2 * rise;
  return {y[i] + s * (left + s * (c2 + s * c3)), (left + s * (2 * c2 + 3 * s * c3)) / h,
          (2 * c2 + 6 * s * c3) / (h * h)};
}

double SampledCurve::least() const {
  return *std::min_element(samples_->y.begin(), samples_->y.end());
}
double SampledCurve::most() const {
  return *std::max_element(samples_->y.begin(), samples_->y.end());
}

std::partial_ordering SampledCurve::operator<=>(const SampledCurve& other) const {
  if (samples_ == other.samples_) return std::partial_ordering::equivalent;
  if (!samples_ || !other.samples_) return bool(samples_) <=> bool(other.samples_);
  if (const auto order = samples_->x <=> other.samples_->x; order != 0) return order;
  return samples_->y <=> other.samples_->y;
}

}  // namespace isofield::operators
