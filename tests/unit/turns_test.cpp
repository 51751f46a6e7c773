// Tests the order in which work gets to the device.
#include "gpu/turns.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "support/eventually.h"

namespace isofield::gpu {
namespace {

const Deadline kSoon = Deadline() + std::chrono::hours(1), kLater = kSoon + std::chrono::hours(1);

// Threads that ask for a turn one after the other while another user holds it, and the order in which they get it.
class Line {
 public:
  Line() : held_(turns_.take({})) {}
  ~Line() { finish(); }

  void join(const Urgency& urgency) {
    const std::size_t place = threads_.size();
    threads_.emplace_back([this, urgency, place] {
      const Turns::Turn turn = turns_.take(urgency);
      order_.push_back(place);  // the turn is the lock
    });
    EXPECT_TRUE(test_support::eventually([this] { return turns_.waiting() >= threads_.size(); }));
  }
  std::vector<std::size_t> finish() {
    held_ = {};
    for (std::thread& t : threads_) t.join();
    threads_.clear();
    return order_;
  }

 private:
  Turns turns_;
  std::vector<std::size_t> order_;
  std::vector<std::thread> threads_;
  Turns::Turn held_;
};

using Order = std::vector<std::size_t>;

TEST(Turns, ShortWorkFirstThenPriorityThenDeadlineThenArrival) {
  const Urgency plain, high{.priority = 1}, soon{.deadline = kSoon}, later{.deadline = kLater},
      brief{.is_short = true, .priority = -1};
  EXPECT_TRUE(is_more_urgent(brief, high));
  EXPECT_TRUE(is_more_urgent(high, soon));
  EXPECT_TRUE(is_more_urgent(soon, later));
  EXPECT_TRUE(is_more_urgent(later, plain));
  EXPECT_FALSE(is_more_urgent(plain, plain));
  Line line;
  line.join(high);
  line.join(soon);
  line.join(brief);
  EXPECT_EQ(line.finish(), (Order{2, 0, 1}));
}

TEST(Turns, EqualOnesComeInTheOrderOfArrival) {
  Line line;
  for (int i = 0; i < 6; ++i) line.join({});
  EXPECT_EQ(line.finish(), (Order{0, 1, 2, 3, 4, 5}));
}

TEST(Turns, EveryFourthGoesToTheOneThatHasWaitedLongest) {
  Line line;
  line.join({.priority = -1});
  for (int i = 0; i < 5; ++i) line.join({.is_short = true, .priority = 1});
  EXPECT_EQ(line.finish(), (Order{1, 2, 3, 0, 4, 5}));
}

TEST(Turns, AFreeDeviceIsTakenAtOnce) {
  Turns turns;
  Turns::Turn turn = turns.take({});
  EXPECT_TRUE(turn);
  turn = {};
  EXPECT_FALSE(turn);
  turn = turns.take({});
  EXPECT_TRUE(turn);
  EXPECT_EQ(turns.waiting(), 0u);
}

}  // namespace
}  // namespace isofield::gpu
