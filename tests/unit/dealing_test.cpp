#include "engine/dealing.h"

#include <gtest/gtest.h>

#include <numeric>

namespace isofield::engine {
namespace {

std::vector<int> numbers(int count) {
  std::vector<int> list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), 0);
  return list;
}

TEST(Dealing, EveryJobIsDealtOnceAndOthersStay) {
  for (const int count : {0, 1, 2, 3, 7, 31, 32, 33, 1000, 5000}) {
    for (const std::uint32_t hands : {1u, 2u, 3u, 16u}) {
      std::vector<int> jobs = numbers(count + 4);
      deal(jobs, 2, static_cast<std::size_t>(count) + 2, hands);
      EXPECT_EQ(jobs[0], 0);
      EXPECT_EQ(jobs.back(), count + 3);
      std::sort(jobs.begin(), jobs.end());
      EXPECT_EQ(jobs, numbers(count + 4)) << count << " to " << hands;
    }
  }
}

TEST(Dealing, OneHandKeepsTheOrder) {
  std::vector<int> jobs = numbers(500);
  deal(jobs, 0, jobs.size(), 1);
  EXPECT_EQ(jobs, numbers(500));
}

// Each job costs as much as its place, because neighbouring jobs cost about the same in practice.
TEST(Dealing, HandsCostTheSame) {
  for (const std::uint32_t hands : {2u, 4u, 16u}) {
    std::vector<int> jobs = numbers(16'000);
    deal(jobs, 0, jobs.size(), hands);
    const auto share = static_cast<std::ptrdiff_t>(jobs.size() / hands);
    const double mean = std::accumulate(jobs.begin(), jobs.end(), 0.0) / hands;
    for (std::ptrdiff_t hand = 0; hand < static_cast<std::ptrdiff_t>(hands); ++hand) {
      const auto from = jobs.begin() + hand * share;
      EXPECT_NEAR(std::accumulate(from, from + share, 0.0), mean, 0.08 * mean);
    }
  }
}

}  // namespace
}  // namespace isofield::engine
