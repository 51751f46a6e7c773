// The largest of many errors.
#pragma once

#include <cmath>

namespace isofield::test_support {

// Keeps the larger of the two errors in `worst`. NaN is the largest there is and stays; std::max would lose it.
inline void keep_worst(double& worst, double error) {
  if (!std::isnan(worst) && !(error <= worst)) worst = error;
}

}  // namespace isofield::test_support
