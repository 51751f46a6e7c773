#include "rpc/answer_limit.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <limits>

namespace isofield::rpc {
namespace {

// A message sets aside so many bytes for its tags, its lengths, its place in the answer and a shape of four numbers.
// These take at most 94.
constexpr std::uint64_t kFraming = 128;
constexpr std::uint64_t kLeastStreamBytes = 64u << 10;
// The size of the largest message that protocol buffers allow.
constexpr std::uint64_t kMostBytes = std::numeric_limits<std::int32_t>::max();

}  // namespace

AnswerLimit::AnswerLimit(std::uint64_t max_answer_bytes)
    : bytes_(max_answer_bytes == 0 ? kDefaultAnswerBytes : std::min(max_answer_bytes, kMostBytes)) {}

absl::StatusOr<AnswerLimit> AnswerLimit::of_stream(std::uint64_t max_answer_bytes) {
  if (max_answer_bytes != 0 && max_answer_bytes < kLeastStreamBytes) {
    return absl::InvalidArgumentError(absl::StrCat("max_answer_bytes = ", max_answer_bytes, ": expected at least ",
                                                   kLeastStreamBytes, ", or 0 for ", kDefaultAnswerBytes));
  }
  return AnswerLimit(max_answer_bytes);
}

std::uint64_t AnswerLimit::rows(std::uint64_t row_bytes) const {
  return std::max<std::uint64_t>((bytes_ - std::min(bytes_, kFraming)) / row_bytes, 1);
}

absl::Status AnswerLimit::admit(std::uint64_t answer_bytes, absl::string_view instead) const {
  if (answer_bytes <= bytes_) return absl::OkStatus();
  return absl::ResourceExhaustedError(absl::StrCat("the answer has at least ", answer_bytes, " bytes, more than the ",
                                                   bytes_, " that the client takes: ", instead,
                                                   ", or state a larger max_answer_bytes"));
}

absl::Status check_number_rows(bool answer_in_numbers, std::uint64_t rows) {
  if (!answer_in_numbers || rows <= kMaxNumberRows) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("answer_in_numbers = true: ", rows, " rows, expected at most ",
                                                 kMaxNumberRows, "; ask for bytes, or for fewer rows"));
}

}  // namespace isofield::rpc
