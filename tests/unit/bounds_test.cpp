// Tests that the box of a scene holds the support of a positive field and the solid of a signed one.
#include <gtest/gtest.h>

#include <cstdio>

#include "blobtree/tape/compiler.h"
#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::Random;

bool holds(const Box& box, const dvec3& p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
         p.z <= box.max.z;
}

TEST(Bounds, HoldEveryPointWhereTheFieldMatters) {
  int inside = 0, beyond = 0, unbounded = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    v1::Scene message = test_support::random_scene(seed, {.nodes = 4 + static_cast<int>(seed % 40)});
    // Half of the scenes get a signed root: if the scene has a conversion, the root is what it converts.
    for (int i = 0; i < message.nodes_size() && seed % 2 == 0; ++i) {
      if (message.nodes(i).has_soften()) message.set_root(message.nodes(i).soften().child());
    }
    const Scene scene = test_support::read_or_die(message);
    const auto tape = compile(scene);
    ASSERT_TRUE(tape.ok());
    if (tape->support.max.x >= kMaxCoordinate) {
      ++unbounded;
      continue;
    }
    const reference::Evaluator evaluator(scene);
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
      const dvec3 p = random.point(-2.5, 2.5);
      const double f = evaluator.value(p);
      const bool matters = tape->law == operators::Law::kSigned ? f <= 0 : f > 0;
      inside += matters;
      beyond += !holds(tape->support, p);
      if (!matters) continue;
      ASSERT_TRUE(holds(tape->support, p)) << "seed " << seed << ": " << f << " at " << p.x << " " << p.y << " " << p.z;
    }
  }
  std::printf("%d points inside, %d beyond the box, %d scenes without bounds\n", inside, beyond, unbounded);
  EXPECT_GT(inside, 3000);
  EXPECT_GT(beyond, 5000);
  EXPECT_LT(unbounded, 40);
}

}  // namespace
}  // namespace isofield::blobtree
