#include "engine/mesh/mesh_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

#include "engine/mesh/mesh_lattice.h"
#include "support/random_scene.h"

namespace isofield::engine {
namespace {

using Place = std::array<std::uint32_t, 3>;

// The bricks that own the first and the last four corners of each octet that a brick does not own itself. They are
// relative to the brick that has the octet.
constexpr std::array<std::array<Place, 2>, kOctets - kOwnOctets> kOwners{{
    {{{1, 0, 0}, {1, 0, 0}}},
    {{{1, 0, 0}, {1, 0, 0}}},
    {{{0, 1, 0}, {0, 1, 0}}},
    {{{0, 1, 0}, {0, 1, 0}}},
    {{{0, 0, 1}, {0, 0, 1}}},
    {{{0, 0, 1}, {0, 0, 1}}},
    {{{1, 1, 0}, {1, 0, 1}}},
    {{{0, 1, 1}, {1, 1, 1}}},
}};

TEST(MeshSamples, OctetsAreEvaluatedOrTakenOverFromTheirOwners) {
  test_support::Random random(4);
  for (const int percent : {10, 60, 95, 100}) {
    std::vector<blobtree::Brick> bricks;
    for (std::uint32_t z = 0; z < 7; ++z) {
      for (std::uint32_t y = 0; y < 6; ++y) {
        for (std::uint32_t x = 0; x < 5; ++x) {
          if (random.integer(1, 100) <= percent) bricks.push_back({x, y, z, 0, 0});
        }
      }
    }
    const auto total = static_cast<std::uint32_t>(bricks.size());
    const std::uint32_t first = total / 5, count = total / 2;
    const SlabOctets octets = slab_octets(brick_neighbours(bricks), first, count);
    ASSERT_EQ(octets.evaluated.size(), count);
    std::map<Place, std::uint32_t> places;  // only the slab's bricks
    for (std::uint32_t b = 0; b < count; ++b) {
      const blobtree::Brick& at = bricks[first + b];
      places[{at.x, at.y, at.z}] = b;
    }
    std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>> taken;
    for (const auto& [b, octet, from, last_from] : octets.taken_over) {
      EXPECT_TRUE(taken.emplace(std::array{b, octet}, std::array{from, last_from}).second) << "twice";
    }
    std::size_t found = 0;
    for (const auto& [at, b] : places) {
      EXPECT_EQ(octets.evaluated[b] & 0xffu, 0xffu);
      for (std::uint32_t octet = kOwnOctets; octet < kOctets; ++octet) {
        std::array<std::uint32_t, 2> owners{};
        bool are_there = true;
        for (std::size_t half = 0; half < 2; ++half) {
          const Place& step = kOwners[octet - kOwnOctets][half];
          const auto owner = places.find({at[0] + step[0], at[1] + step[1], at[2] + step[2]});
          are_there = are_there && owner != places.end();
          if (are_there) owners[half] = owner->second;
        }
        const auto it = taken.find({b, octet});
        ASSERT_NE(it == taken.end(), (octets.evaluated[b] >> octet & 1) == 0) << "octet " << octet;
        if (it == taken.end()) {
          // The last corner's owner may exist unseen, if the brick between them is missing.
          EXPECT_TRUE(!are_there || octet == kOctets - 1) << "octet " << octet;
          continue;
        }
        ++found;
        ASSERT_TRUE(are_there) << "octet " << octet;
        EXPECT_EQ(it->second, owners) << "octet " << octet;
      }
    }
    EXPECT_EQ(found, octets.taken_over.size());
    EXPECT_TRUE(percent < 100 || found > std::size_t{4} * count);
  }
}

}  // namespace
}  // namespace isofield::engine
