#include "blobtree/geometry/affine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random_scene.h"

namespace isofield::blobtree {
namespace {

using test_support::Random;

void expect_near(const dvec3& a, const dvec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

Affine random_affine(Random& random) {
  Affine a;
  for (dvec3& row : a.linear) row = random.point(-1, 1);
  a.offset = random.point(-3, 3);
  return a;
}

TEST(Affine, AfterAppliesTheOtherFirst) {
  Random random(1);
  for (int n = 0; n < 100; ++n) {
    const Affine a = random_affine(random), b = random_affine(random);
    const dvec3 p = random.point(-2, 2);
    expect_near(a.after(b).point(p), a.point(b.point(p)), 1e-13);
    expect_near(a.after(b).vector(p), a.vector(b.vector(p)), 1e-13);
  }
}

TEST(Affine, InverseUndoes) {
  Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Affine a = random_affine(random);
    const auto inverse = a.inverse();
    ASSERT_TRUE(inverse.has_value());
    const dvec3 p = random.point(-2, 2);
    const double room = 1e-13 / a.stretch().least;
    expect_near(inverse->point(a.point(p)), p, room);
    expect_near(a.point(inverse->point(p)), p, room);
  }
  EXPECT_FALSE(Affine::scale({1, 0, 2}).inverse().has_value());
}

TEST(Affine, StretchIsReachedAndNeverPassed) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Affine a = random_affine(random);
    const Affine::Stretch s = a.stretch();
    double least = 1e300, most = 0;
    for (int i = 0; i < 2000; ++i) {
      const dvec3 v = random.point(-1, 1);
      const double factor = length(a.vector(v)) / length(v);
      ASSERT_LE(factor, s.most * (1 + 1e-12));
      ASSERT_GE(factor, s.least * (1 - 1e-9) - 1e-12);
      least = std::min(least, factor);
      most = std::max(most, factor);
    }
    EXPECT_GT(most, 0.9 * s.most);
    EXPECT_LT(least, s.least + 0.1 * s.most);
  }
}

TEST(Affine, StretchOfKnownMaps) {
  const Affine::Stretch s = Affine::scale({-3, 0.5, 2}).stretch();
  EXPECT_NEAR(s.least, 0.5, 1e-14);
  EXPECT_NEAR(s.most, 3, 1e-14);
  // A scale between two rotations has the stretch of the scale alone.
  const Affine turned =
      Affine::rotation({1, 2, 3}, 0.7).after(Affine::scale({1000, 1, 0.01})).after(Affine::rotation({-1, 1, 5}, 2.1));
  EXPECT_NEAR(turned.stretch().most, 1000, 1e-9);
  EXPECT_NEAR(turned.stretch().least, 0.01, 1e-6);
}

TEST(Affine, GradientFrameKeepsTheLengthsAndAnglesBeforeTheMap) {
  Random random(6);
  for (int n = 0; n < 200; ++n) {
    const Affine map{{random.point(-2, 2), random.point(-2, 2), random.point(-2, 2)}, {}};
    const Affine::LowerTriangle l = map.gradient_frame();
    const auto framed = [&](const dvec3& g) {
      return dvec3{l[0] * g.x + l[1] * g.y + l[3] * g.z, l[2] * g.y + l[4] * g.z, l[5] * g.z};
    };
    const auto before = [&](const dvec3& g) {  // A^T g
      return map.linear[0] * g.x + map.linear[1] * g.y + map.linear[2] * g.z;
    };
    const dvec3 g = random.point(-1, 1), other = random.point(-1, 1);
    EXPECT_NEAR(dot(framed(g), framed(other)), dot(before(g), before(other)), 1e-12);
    EXPECT_NEAR(length(framed(g)), length(before(g)), 1e-12);
  }
}

TEST(Affine, SimilaritiesAreToldApart) {
  const Affine turned = Affine::rotation({1, 2, 3}, 0.7);
  EXPECT_TRUE(turned.after(Affine::scale({-2, 2, 2})).is_similarity(1e-12));
  EXPECT_FALSE(turned.after(Affine::scale({1, 1, 1.001})).is_similarity(1e-4));
  EXPECT_TRUE(turned.after(Affine::scale({1, 1, 1.00001})).is_similarity(1e-4));
}

TEST(Affine, RotationTurnsByTheRightHand) {
  expect_near(Affine::rotation({0, 0, 2}, std::numbers::pi / 2).point({1, 0, 0}), {0, 1, 0}, 1e-15);
  expect_near(Affine::rotation({3, 0, 0}, std::numbers::pi / 2).point({0, 1, 0}), {0, 0, 1}, 1e-15);
  expect_near(Affine::rotation({1, 1, 1}, 2 * std::numbers::pi / 3).point({1, 0, 0}), {0, 1, 0}, 1e-15);
}

TEST(Affine, FrameIsRigidAndTakesZToTheDirection) {
  Random random(4);
  for (int n = 0; n < 200; ++n) {
    dvec3 direction = random.point(-1, 1);
    if (n < 6) direction = {n / 2 == 0 ? 1.0 : 0.0, n / 2 == 1 ? 1.0 : 0.0, n / 2 == 2 ? 1.0 : 0.0};
    if (n % 2 == 1) direction = direction * -1e-5;
    const dvec3 origin = random.point(-2, 2);
    const Affine f = Affine::frame(origin, direction);
    expect_near(f.point({}), origin, 0);
    expect_near(f.vector({0, 0, 1}), direction * (1 / length(direction)), 1e-14);
    EXPECT_NEAR(f.stretch().least, 1, 1e-12);
    EXPECT_NEAR(f.stretch().most, 1, 1e-12);
    // The frame is right-handed.
    expect_near(cross(f.vector({1, 0, 0}), f.vector({0, 1, 0})), f.vector({0, 0, 1}), 1e-14);
  }
}

}  // namespace
}  // namespace isofield::blobtree
