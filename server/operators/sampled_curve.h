// SampledCurve is a function of one variable given by samples: the monotone cubic of Fritsch and Carlson (1980), flat
// at both ends and constant beyond.
#pragma once

#include <compare>
#include <memory>
#include <vector>

#include "operators/derivatives.h"

namespace isofield::operators {

// Curves are compared by their samples. Copies share the samples.
class SampledCurve {
 public:
  SampledCurve() = default;
  // The numbers in `x` increase strictly. There are as many as in `y`, and at least 2.
  SampledCurve(std::vector<double> x, std::vector<double> y);
  // Makes a curve whose samples lie at even steps over [low, high].
  static SampledCurve even(double low, double high, std::vector<double> y);

  bool empty() const { return !samples_; }
  Curve at(double x) const;
  double least() const;
  double most() const;

  const std::vector<double>& x() const { return samples_->x; }
  const std::vector<double>& y() const { return samples_->y; }

  std::partial_ordering operator<=>(const SampledCurve& other) const;
  bool operator==(const SampledCurve& other) const { return (*this <=> other) == 0; }

 private:
  struct Samples {
    std::vector<double> x, y, slope;
  };
  std::shared_ptr<const Samples> samples_;
};

}  // namespace isofield::operators
