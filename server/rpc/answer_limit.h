// Decides how large the messages of an answer may be, and how much fits into one; no other place does.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isofield::rpc {

// The largest message, in bytes, that gRPC's clients accept unless they are told otherwise.
inline constexpr std::uint64_t kDefaultAnswerBytes = 4u << 20;
// The most bytes in a part of a mesh or a scene. With everything else in its message, it stays far below
// kDefaultAnswerBytes.
inline constexpr std::uint64_t kPartBytes = 1u << 20;
// The most rows that a request or an answer may have as plain numbers.
inline constexpr std::uint64_t kMaxNumberRows = 4096;

class AnswerLimit {
 public:
  AnswerLimit() = default;
  // `max_answer_bytes` as requests state it: 0 for gRPC's default.
  explicit AnswerLimit(std::uint64_t max_answer_bytes);
  // The limit of a stream, each of whose messages must have room for some rows. INVALID_ARGUMENT: it is below 64 KiB.
  static absl::StatusOr<AnswerLimit> of_stream(std::uint64_t max_answer_bytes);

  std::uint64_t bytes() const { return bytes_; }
  // The number of rows of `row_bytes` that fit into a message beside its own tags, lengths and shapes; at least 1.
  std::uint64_t rows(std::uint64_t row_bytes) const;
  // RESOURCE_EXHAUSTED: an answer of `answer_bytes` or more is too large. `instead` says what the client can do, such
  // as "ask for fewer rows".
  absl::Status admit(std::uint64_t answer_bytes, absl::string_view instead) const;

 private:
  std::uint64_t bytes_ = kDefaultAnswerBytes;
};

// Counts the bytes of a list that must fit into a message of kDefaultAnswerBytes.
class AnswerPage {
 public:
  // True where an entry of so many bytes has room after those that were admitted before.
  bool admit(std::uint64_t entry_bytes) {
    constexpr std::uint64_t kEntryHead = 6;  // its tag and length
    bytes_ += entry_bytes + kEntryHead;
    return bytes_ <= kDefaultAnswerBytes;
  }

 private:
  std::uint64_t bytes_ = 2;  // the field has_more takes two
};

// Cuts an array of rows of `columns` numbers into parts of whole rows, of at most kPartBytes, and calls write(part) for
// each of them; an empty array has no part. Ends with the first error of write().
template <class T, class Write>
absl::Status in_parts(std::span<const T> numbers, std::size_t columns, const Write& write) {
  const std::size_t most = kPartBytes / (columns * sizeof(T)) * columns;
  for (std::size_t at = 0; at < numbers.size(); at += most) {
    if (absl::Status s = write(numbers.subspan(at, std::min(most, numbers.size() - at))); !s.ok()) return s;
  }
  return absl::OkStatus();
}

// INVALID_ARGUMENT: the answer is to have plain numbers, and has more than kMaxNumberRows rows.
absl::Status check_number_rows(bool answer_in_numbers, std::uint64_t rows);

// What a client can do where an answer has too many rows.
inline constexpr char kFewerRows[] = "ask for fewer rows";

// Refuses a request for too large an answer before the work, by the bytes that a row of it takes at least.
template <class Request>
absl::Status check_answer_rows(const Request& request, std::uint64_t rows, std::uint64_t row_bytes) {
  if (absl::Status s = check_number_rows(request.answer_in_numbers(), rows); !s.ok()) return s;
  return AnswerLimit(request.max_answer_bytes()).admit(rows * row_bytes, kFewerRows);
}

}  // namespace isofield::rpc
