#include "base/workers.h"

#include <gtest/gtest.h>

#include <latch>

namespace isofield::engine {
namespace {

TEST(Workers, EachIsDoneOnce) {
  for (const unsigned threads : {0u, 1u, 3u}) {
    base::Workers workers(threads);
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> done(count);
      workers.for_each(count, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

// Each call waits for the other, so this would not end on one thread.
TEST(Workers, AreSpreadOverThreads) {
  base::Workers workers(1);
  std::latch both(2);
  workers.for_each(2, [&](std::size_t) { both.arrive_and_wait(); });
}

TEST(Workers, ManyMayAskAtOnceAndFromWithin) {
  base::Workers workers(2);
  std::atomic<int> done = 0;
  std::vector<std::thread> callers;
  for (int c = 0; c < 8; ++c) {
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round) {
        workers.for_each(20, [&](std::size_t) { workers.for_each(3, [&](std::size_t) { ++done; }); });
      }
    });
  }
  for (std::thread& t : callers) t.join();
  EXPECT_EQ(done, 8 * 50 * 20 * 3);
}

}  // namespace
}  // namespace isofield::engine
