#include "blobtree/cull/intervals.h"

#include <gtest/gtest.h>

#include <numbers>

#include "blobtree/tape/operation.h"
#include "operators/gradient_blend.h"
#include "support/random_scene.h"

namespace isofield::blobtree {
namespace {

using operators::Silhouette;
using test_support::Random;

Operation blend_of(const Silhouette& silhouette) {
  auto op = std::make_shared<operators::Operator>(operators::Gradient{.silhouette = silhouette});
  operators::SilhouetteBounds silhouettes;
  return operation_of(std::move(op), operators::Law::kPositive, 2, silhouettes);
}

TEST(Intervals, OfGradientBlendsHoldAtEveryAngle) {
  Random random(1);
  for (const Silhouette& silhouette :
       {Silhouette{}, Silhouette{Silhouette::Kind::kBulge, 0.4}, Silhouette{Silhouette::Kind::kBulge, 1}}) {
    const Operation o = blend_of(silhouette);
    for (int n = 0; n < 3000; ++n) {
      // Every fifth case has fields above 1, as sums do.
      const double scale = n % 5 == 0 ? 4 : 1;
      const auto interval = [&] {
        const double lo = random.chance(0.2) ? 0 : random.number(0, scale);
        return Interval{lo, lo + random.number(0, 0.3)};
      };
      const Interval a = interval(), b = interval();
      const Interval g = binary_interval(o.op, o, {}, a, b);
      for (int i = 0; i < 6; ++i) {
        // The first cases take the upper ends and the widest blend.
        const double f1 = i < 2 ? a.hi : random.number(a.lo, a.hi), f2 = i < 2 ? b.hi : random.number(b.lo, b.hi);
        const double theta = i == 0 ? 0 : random.number(0, std::numbers::pi / 4);
        const double value = operators::gradient_blend(f1, f2, theta, silhouette).g;
        ASSERT_GE(value, g.lo) << f1 << " " << f2 << " " << theta;
        ASSERT_LE(value, g.hi) << f1 << " " << f2 << " " << theta;
      }
    }
  }
}

TEST(Intervals, OfSmoothGradientBlendsAreReached) {
  const Operation o = blend_of({});
  for (const double ratio : {0.0, 0.1, 0.35, 0.5, 0.77, 1.0}) {
    const double high = 0.6, most = operators::gradient_blend(high, ratio * high, 0, {}).g;
    EXPECT_NEAR(binary_interval(o.op, o, {}, {0, high}, {0, ratio * high}).hi, most, 1e-4) << ratio;
    EXPECT_NEAR(binary_interval(o.op, o, {}, {0, ratio * high}, {0, high}).hi, most, 1e-4) << ratio;
  }
}

Operation functional_of(std::vector<double> x, std::vector<double> h) {
  auto op =
      std::make_shared<operators::Operator>(operators::Functional{operators::SampledCurve(std::move(x), std::move(h))});
  operators::SilhouetteBounds silhouettes;
  return operation_of(std::move(op), operators::Law::kSigned, 2, silhouettes);
}

TEST(Intervals, OfFunctionalBlendsHold) {
  Random random(3);
  const Operation operations[] = {functional_of({0, 0.2, 0.5}, {0.3, 0.2, 0}), functional_of({0.1, 0.4}, {-0.2, 0.3}),
                                  functional_of({0, 0.3, 0.6, 0.9}, {0, 0.5, -0.5, 0.1})};
  for (const Operation& o : operations) {
    for (int n = 0; n < 2000; ++n) {
      const auto interval = [&] {
        const double lo = random.number(-1.5, 1.5);
        return Interval{lo, lo + random.number(0, 0.6)};
      };
      const Interval a = interval(), b = interval(), g = binary_interval(o.op, o, {}, a, b);
      const int alone = lone_operand(o, {}, a, b);
      for (int i = 0; i < 8; ++i) {
        const double f1 = random.number(a.lo, a.hi), f2 = random.number(b.lo, b.hi);
        const auto r = o.what->as<operators::Functional>()->unite(f1, f2);
        ASSERT_GE(r.g, g.lo) << f1 << " " << f2;
        ASSERT_LE(r.g, g.hi) << f1 << " " << f2;
        if (alone >= 0) {
          ASSERT_EQ(r.g, alone == 0 ? f1 : f2);
          ASSERT_EQ(r.g1, alone == 0 ? 1 : 0);
        }
      }
    }
  }
}

TEST(Intervals, AFunctionalBlendIsOneOperandWhereItsCurveHasEndedWith0) {
  const Operation o = functional_of({0, 0.5}, {0.3, 0}), lifted = functional_of({0, 0.5}, {0.3, 0.1});
  const Interval low{-0.2, 0}, high{0.51, 2};
  EXPECT_EQ(lone_operand(o, {}, low, high), 0);
  EXPECT_EQ(lone_operand(o, {}, high, low), 1);
  EXPECT_EQ(lone_operand(o, {}, low, {0.49, 2}), -1);
  EXPECT_EQ(lone_operand(lifted, {}, low, high), -1);
  const Mode intersection{operators::Form::kIntersection, true, false};
  const Mode difference{operators::Form::kDifference, true, false};
  EXPECT_EQ(lone_operand(o, intersection, low, high), 1);
  EXPECT_EQ(lone_operand(o, difference, {-0.2, 0}, {-3, -2}), -1);  // the subtrahend alone is no result
  EXPECT_EQ(lone_operand(o, difference, {1, 1.2}, {0, 2}), 0);
}

// The fields are positive and above 1, as those of sums can be.
TEST(Intervals, OfIntersectionsOfFieldsAboveOneHold) {
  Random random(5);
  const Mode mode{operators::Form::kIntersection, false, false};
  const Operation o = blend_of({});
  for (int n = 0; n < 3000; ++n) {
    const auto interval = [&] {
      const double lo = random.number(0, 1.8);
      return Interval{lo, lo + random.number(0, 0.8)};
    };
    const Interval a = interval(), b = interval(), g = binary_interval(o.op, o, mode, a, b);
    for (int i = 0; i < 6; ++i) {
      const double f1 = i == 0 ? a.hi : random.number(a.lo, a.hi), f2 = i == 0 ? b.hi : random.number(b.lo, b.hi);
      const double least = std::min(f1, f2);
      const double union_of = operators::gradient_blend(std::max(1 - f1, 0.0), std::max(1 - f2, 0.0), 0.3, {}).g;
      const double value = least >= 1 ? least : std::max(1 - union_of, 0.0);
      ASSERT_GE(value, g.lo) << f1 << " " << f2;
      ASSERT_LE(value, g.hi) << f1 << " " << f2;
    }
  }
}

}  // namespace
}  // namespace isofield::blobtree
