#include "operators/functional.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_scene.h"

namespace isofield::operators {
namespace {

// The test compares [G] eq. 6, min(x1, x2) - H(|x1 - x2|), at differences where H is known.
TEST(FunctionalBlend, TakesTheCurveOfTheDifferenceFromTheLesserField) {
  const Functional blend{SampledCurve({0.1, 0.4, 1}, {0.5, 0.2, 0.05})};
  for (const double x : {-3.0, -0.2, 0.0, 0.7}) {
    EXPECT_DOUBLE_EQ(blend.unite(x, x).g, x - 0.5);  // the curve is constant before the first control point
    EXPECT_DOUBLE_EQ(blend.unite(x, x + 0.05).g, x - 0.5);
    EXPECT_NEAR(blend.unite(x, x + 0.4).g, x - 0.2, 1e-15);
    EXPECT_NEAR(blend.unite(x + 0.4, x).g, x - 0.2, 1e-15);
    EXPECT_DOUBLE_EQ(blend.unite(x, x + 7).g, x - 0.05);  // and beyond the last one
    EXPECT_EQ(blend.unite(x, x + 7).g1, 1);
    EXPECT_EQ(blend.unite(x, x + 7).g2, 0);
  }
}

TEST(FunctionalBlend, IsSymmetricAndHasItsPartials) {
  const Functional blend{SampledCurve({0, 0.2, 0.3, 0.9}, {0.4, 0.3, 0.25, 0})};
  test_support::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double x1 = random.number(-1, 1), x2 = random.number(-1, 1), step = 1e-6;
    const Binary<double> b = blend.unite(x1, x2), e = blend.unite(x2, x1);
    EXPECT_EQ(b.g, e.g);
    EXPECT_EQ(b.g1, e.g2);
    EXPECT_DOUBLE_EQ(b.g1 + b.g2, 1);
    if (std::abs(x1 - x2) < 2 * step) continue;
    const double slope1 = (blend.unite(x1 + step, x2).g - blend.unite(x1 - step, x2).g) / (2 * step);
    EXPECT_NEAR(b.g1, slope1, 2e-5);
  }
  // If the fields are equal, the partials are those of one side.
  const Binary<double> tie = blend.unite(0.3, 0.3);
  EXPECT_EQ(std::max(tie.g1, tie.g2), 1);
  EXPECT_EQ(std::min(tie.g1, tie.g2), 0);
}

}  // namespace
}  // namespace isofield::operators
