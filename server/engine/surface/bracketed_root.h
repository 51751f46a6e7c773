// BracketedRoot finds a root between two points by the ITP method (Oliveira, Takahashi 2020). It needs at most one
// evaluation more than bisection, and is mostly as fast as the secant method.
#pragma once

#include <algorithm>
#include <cmath>

namespace isofield::engine {

// Narrows down a change of sign of a function f within [low, high]: until done(), the caller evaluates f at next() and
// passes the value to take().
class BracketedRoot {
 public:
  // f(low) and f(high) must not be both > 0, nor both <= 0. `tolerance` > 0 says how far root() may be off.
  BracketedRoot(double low, double high, double f_low, double f_high, double tolerance)
      : low_(low), high_(high), f_low_(f_low), f_high_(f_high), tolerance_(tolerance) {
    const double halvings = std::ceil(std::log2(std::max((high - low) / (2 * tolerance), 1.0)));
    reach_ = tolerance * std::exp2(halvings + 1);
    left_ = static_cast<int>(halvings) + 1;
    truncation_ = 0.2 / std::max(high - low, tolerance);
  }

  // Becomes true even if rounding leaves no number between the two ends, because the evaluations are limited.
  bool done() const { return left_ <= 0 || high_ - low_ <= 2 * tolerance_; }
  double root() const { return 0.5 * (low_ + high_); }

  // Returns the point at which to evaluate f next.
  double next() {
    const double width = high_ - low_, middle = root();
    const double room = std::max(reach_ - 0.5 * width, 0.0);
    reach_ *= 0.5;
    const double secant = (f_high_ * low_ - f_low_ * high_) / (f_high_ - f_low_);
    const double side = secant <= middle ? 1 : -1;
    const double shift = truncation_ * width * width;
    const double truncated = shift <= std::abs(middle - secant) ? secant + side * shift : middle;
    x_ = std::abs(truncated - middle) <= room ? truncated : middle - side * room;
    return x_;
  }
  void take(double f) {
    --left_;
    if ((f > 0) == (f_low_ > 0)) {
      low_ = x_;
      f_low_ = f;
    } else {
      high_ = x_;
      f_high_ = f;
    }
  }

 private:
  double low_, high_, f_low_, f_high_, tolerance_;
  double reach_;       // half the width that bisection with one evaluation fewer would have left by now
  double truncation_;  // kappa_1 of the method; kappa_2 = 2, n_0 = 1
  double x_ = 0;
  int left_;  // the most evaluations that are left
};

}  // namespace isofield::engine
