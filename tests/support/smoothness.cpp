#include "support/smoothness.h"

#include <algorithm>
#include <cmath>

namespace isofield::test_support {

double gradient_variation(const reference::Evaluator& evaluator, const blobtree::dvec3& p, double offset) {
  const blobtree::dvec3 here = evaluator.evaluate(p).gradient;
  double most = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int moved = std::abs(x) + std::abs(y) + std::abs(z);
        if (moved != 1 && moved != 3) continue;
        const double step = offset / std::sqrt(moved);
        const blobtree::dvec3 q = p + blobtree::dvec3{x * step, y * step, z * step};
        most = std::max(most, length(evaluator.evaluate(q).gradient - here));
      }
    }
  }
  return most;
}

}  // namespace isofield::test_support
