// Tests how answers are cut into messages.
#include "rpc/answer_limit.h"

#include <gtest/gtest.h>

#include "isofield/v1/field_service.pb.h"
#include "rpc/grid_parts.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

// Returns the size of the largest message with so many rows of a grid: every number that states a place is large.
std::uint64_t grid_message_bytes(std::uint64_t rows, std::uint64_t columns) {
  v1::EvaluateGridResponse response;
  response.set_first_layer(~0ull);
  response.set_first_row(~0ull);
  response.set_first_column(~0ull);
  make_float_tensor({1, 1, rows, columns}, *response.mutable_result());
  return response.ByteSizeLong();
}

TEST(AnswerLimits, RowsFitWithTheirMessagesOverhead) {
  for (const std::uint64_t asked : {0u, 65536u, 100'000u, 4u << 20, 64u << 20}) {
    const AnswerLimit limit = *AnswerLimit::of_stream(asked);
    for (const std::uint64_t columns : {1u, 4u}) {
      const std::uint64_t rows = limit.rows(4 * columns);
      EXPECT_LE(grid_message_bytes(rows, columns), asked == 0 ? 4194304 : asked);
      EXPECT_GT(grid_message_bytes(rows, columns) + 256, limit.bytes()) << "no room is wasted";
    }
  }
}

TEST(AnswerLimits, StreamsNeedRoomForSomeRows) {
  EXPECT_EQ(AnswerLimit::of_stream(65535).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(AnswerLimit::of_stream(1).status().message().find("max_answer_bytes = 1: expected at least 65536"),
            std::string::npos);
  EXPECT_EQ(AnswerLimit(~0ull).bytes(), 2147483647u) << "a message of protobuf's";
  EXPECT_EQ(AnswerLimit(1).rows(16), 1u);
}

TEST(AnswerLimits, LargerAnswersAreRefusedWithAWordOnWhatToDo) {
  EXPECT_TRUE(AnswerLimit(0).admit(4194304, "").ok());
  const absl::Status refused = AnswerLimit(1000).admit(1001, "ask for fewer rows");
  EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
  for (const char* part : {"1001", "1000", "ask for fewer rows", "max_answer_bytes"}) {
    EXPECT_NE(refused.message().find(part), std::string::npos) << refused;
  }
}

TEST(AnswerLimits, PagesEndBeforeTheyAreTooLarge) {
  AnswerPage page;
  std::uint64_t entries = 0;
  while (page.admit(250)) ++entries;
  EXPECT_LE(entries * (250 + 3) + 2, 4194304u);
  EXPECT_GT(entries, 16'000u);
  EXPECT_TRUE(AnswerPage().admit(4u << 19));
  EXPECT_FALSE(AnswerPage().admit(4u << 20));
}

TEST(AnswerLimits, PartsAreWholeRowsInOrder) {
  std::vector<std::uint32_t> numbers(3 * 200'000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint32_t>(i);
  std::vector<std::uint32_t> joined;
  std::size_t parts = 0;
  EXPECT_TRUE(in_parts(std::span<const std::uint32_t>(numbers), 3, [&](std::span<const std::uint32_t> part) {
                EXPECT_EQ(part.size() % 3, 0u);
                EXPECT_LE(part.size_bytes(), kPartBytes);
                joined.insert(joined.end(), part.begin(), part.end());
                ++parts;
                return absl::OkStatus();
              }).ok());
  EXPECT_EQ(joined, numbers);
  EXPECT_EQ(parts, 3u);
  const auto fail = [](std::span<const std::uint32_t>) { return absl::CancelledError("gone"); };
  EXPECT_TRUE(in_parts(std::span<const std::uint32_t>(), 3, fail).ok());
  std::size_t calls = 0;
  const absl::Status status = in_parts(std::span<const std::uint32_t>(numbers), 3, [&](auto) {
    return ++calls < 2 ? absl::OkStatus() : absl::CancelledError("gone");
  });
  EXPECT_EQ(status.message(), "gone");
  EXPECT_EQ(calls, 2u);
}

TEST(GridParts, FollowOneAnotherAndKeepTheLimit) {
  for (const std::array<std::uint64_t, 3>& counts :
       {std::array<std::uint64_t, 3>{1, 1, 1}, {5, 4, 3}, {7, 1, 9}, {1, 7, 9}, {64, 3, 5}}) {
    const auto [nx, ny, nz] = counts;
    for (std::uint64_t most = 1; most <= nx * ny * nz + 1; ++most) {
      std::uint64_t next = 0;
      for (const GridPart& part : grid_parts(counts, most)) {
        const auto [x, y, z] = part.first;
        const auto [columns, rows, layers] = part.counts;
        EXPECT_EQ((z * ny + y) * nx + x, next);
        EXPECT_LE(columns * rows * layers, most);
        EXPECT_GT(columns * rows * layers, 0u);
        EXPECT_TRUE(columns == nx || rows * layers == 1) << "points of one row";
        EXPECT_TRUE(rows == ny || layers == 1) << "rows of one layer";
        // A part has whole layers if it can hold one layer.
        if (most >= nx * ny) {
          EXPECT_EQ(columns * rows, nx * ny);
        }
        if (most >= nx) {
          EXPECT_EQ(columns, nx);
        }
        next += columns * rows * layers;
      }
      EXPECT_EQ(next, nx * ny * nz) << most;
    }
  }
}

}  // namespace
}  // namespace isofield::rpc
