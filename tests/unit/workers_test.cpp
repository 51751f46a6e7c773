#include "base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "support/eventually.h"

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

// Each of the two calls waits for the other to begin; on one thread the first would wait in vain.
TEST(Workers, AreSpreadOverThreads) {
  base::Workers workers(1);
  std::atomic<int> begun = 0, met = 0;
  workers.for_each(2, [&](std::size_t) {
    ++begun;
    met += test_support::eventually([&] { return begun == 2; });
  });
  EXPECT_EQ(met, 2);
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
