#include "engine/points/result_layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace isofield::engine {
namespace {

// The place of a row in the table is the number of its quantity, and first() relies on it.
TEST(ResultLayout, TheTableIsInTheOrderOfTheQuantities) {
  for (std::size_t i = 0; i < kQuantities.size(); ++i) EXPECT_EQ(static_cast<std::size_t>(kQuantities[i].quantity), i);
}

TEST(ResultLayout, ARowHoldsWhatIsAskedInOrder) {
  constexpr ResultLayout kValue = ResultLayout::kValue, kBoth = ResultLayout::kValueAndGradient;
  EXPECT_EQ(kValue.numbers(), 1u);
  EXPECT_EQ(kBoth.numbers(), 4u);
  EXPECT_EQ(kBoth.numbers(5), 20u);
  EXPECT_EQ(kBoth.bytes(), 16u);
  EXPECT_EQ(kBoth.first(Quantity::kValue), 0u);
  EXPECT_EQ(kBoth.first(Quantity::kGradient), 1u);
  EXPECT_TRUE(kBoth.has(Quantity::kGradient));
  EXPECT_FALSE(kValue.has(Quantity::kGradient));
  EXPECT_EQ(kValue.names(), "value");
  EXPECT_EQ(kBoth.names(), "value, gx, gy, gz");
  const ResultLayout gradient{Quantity::kGradient};
  EXPECT_EQ(gradient.numbers(), 3u);
  EXPECT_EQ(gradient.first(Quantity::kGradient), 0u);
  EXPECT_FALSE(gradient == kBoth || kValue == kBoth);
}

TEST(ResultLayout, RowsAreReadByPointAndQuantity) {
  const std::vector<float> numbers{1, 2, 3, 4, 5, 6, 7, 8};
  const ResultRows rows(ResultLayout::kValueAndGradient, numbers);
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.value(1), 5);
  EXPECT_EQ(rows.gradient(0), (std::array<float, 3>{2, 3, 4}));
  EXPECT_EQ(rows.gradient(1), (std::array<float, 3>{6, 7, 8}));
  EXPECT_EQ(ResultRows(ResultLayout::kValue, numbers).value(7), 8);
}

}  // namespace
}  // namespace isofield::engine
