#include "support/smoothness.h"

#include <algorithm>
#include <cmath>

namespace isofield::test_support {
namespace {

using blobtree::dvec3;

// Returns the largest difference(gradient at p, gradient nearby).
template <class Difference>
double variation(const reference::Evaluator& evaluator, const dvec3& p, double offset, const Difference& difference) {
  const dvec3 here = evaluator.evaluate(p).gradient;
  double most = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int moved = std::abs(x) + std::abs(y) + std::abs(z);
        if (moved != 1 && moved != 3) continue;
        const double step = offset / std::sqrt(moved);
        const dvec3 q = p + dvec3{x * step, y * step, z * step};
        most = std::max(most, difference(here, evaluator.evaluate(q).gradient));
      }
    }
  }
  return most;
}

}  // namespace

double gradient_variation(const reference::Evaluator& evaluator, const dvec3& p, double offset) {
  return variation(evaluator, p, offset, [](const dvec3& a, const dvec3& b) { return length(b - a); });
}

double direction_variation(const reference::Evaluator& evaluator, const dvec3& p, double offset) {
  return variation(evaluator, p, offset,
                   [](const dvec3& a, const dvec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); });
}

}  // namespace isofield::test_support
