// Tests how numbers of requests that describe places and values are read.
#include "rpc/geometry_arguments.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

namespace isofield::rpc {
namespace {

using operators::Law;

TEST(ReadIso, TakesTheValuesOfTheFieldsLaw) {
  EXPECT_EQ(*read_iso(std::optional<double>(), Law::kPositive), 0.5);
  EXPECT_EQ(*read_iso(std::optional<double>(), Law::kSigned), 0);
  EXPECT_EQ(*read_iso(std::optional(0.25), Law::kPositive), 0.25);
  for (const double iso : {-1e9, -2.5, 0.0, 1e9}) EXPECT_EQ(*read_iso(std::optional(iso), Law::kSigned), iso);
}

TEST(ReadIso, RefusesOthersAndSaysWhichItTakes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [law, range, values] :
       {std::tuple(Law::kSigned, "a finite number of magnitude at most 1e+09", std::array{2e9, -2e9, kInfinity, kNaN}),
        std::tuple(Law::kPositive, "within ]0, 1[", std::array{0.0, 1.0, 2e9, kNaN})}) {
    for (const double iso : values) {
      const absl::Status status = read_iso(std::optional(iso), law).status();
      EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << iso;
      EXPECT_NE(std::string(status.message()).find(range), std::string::npos) << status;
    }
  }
}

}  // namespace
}  // namespace isofield::rpc
