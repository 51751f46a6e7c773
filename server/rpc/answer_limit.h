// Decides how large the messages of an answer may be, and how much fits into one. All services ask here.
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

// The largest message that the client of one request accepts.
class AnswerLimit {
 public:
  AnswerLimit() = default;
  // `max_answer_bytes` is what the request states; 0 means gRPC's default.
  explicit AnswerLimit(std::uint64_t max_answer_bytes);
  // Returns the limit for a stream, in which each message must have room for some rows. INVALID_ARGUMENT: the limit is
  // below 64 KiB.
  static absl::StatusOr<AnswerLimit> of_stream(std::uint64_t max_answer_bytes);

  std::uint64_t bytes() const { return bytes_; }
  // Returns how many rows of `row_bytes` fit into a message beside its own tags, lengths and shapes; at least 1.
  std::uint64_t rows(std::uint64_t row_bytes) const;
  // Checks that an answer of at least `answer_bytes` is not too large. `instead` says what the client can do otherwise,
  // such as "ask for fewer rows". RESOURCE_EXHAUSTED: the answer is too large.
  absl::Status admit(std::uint64_t answer_bytes, absl::string_view instead) const;

 private:
  std::uint64_t bytes_ = kDefaultAnswerBytes;
};

// Fills a message of kDefaultAnswerBytes with the entries of a list, by counting their bytes.
class AnswerPage {
 public:
  // Adds an entry of `entry_bytes`, and tells whether it still fits into the message.
  bool admit(std::uint64_t entry_bytes) {
    constexpr std::uint64_t kEntryHead = 6;  // its tag and length
    bytes_ += entry_bytes + kEntryHead;
    return bytes_ <= kDefaultAnswerBytes;
  }

 private:
  std::uint64_t bytes_ = 2;  // the field has_more takes two bytes
};

// Cuts an array, whose rows have `columns` numbers, into parts of whole rows and of at most kPartBytes, and calls
// write(part) for each part. An empty array has no parts. Ends with the first error of write().
template <class T, class Write>
absl::Status in_parts(std::span<const T> numbers, std::size_t columns, const Write& write) {
  const std::size_t most = kPartBytes / (columns * sizeof(T)) * columns;
  for (std::size_t at = 0; at < numbers.size(); at += most) {
    if (absl::Status s = write(numbers.subspan(at, std::min(most, numbers.size() - at))); !s.ok()) return s;
  }
  return absl::OkStatus();
}

// INVALID_ARGUMENT: the request asks for plain numbers, and the answer has more than kMaxNumberRows rows.
absl::Status check_number_rows(bool answer_in_numbers, std::uint64_t rows);

// Tells a client what it can do if an answer has too many rows.
inline constexpr char kFewerRows[] = "ask for fewer rows";

// Refuses a request before the work is done if its answer will be too large. A row takes at least `row_bytes`.
template <class Request>
absl::Status check_answer_rows(const Request& request, std::uint64_t rows, std::uint64_t row_bytes) {
  if (absl::Status s = check_number_rows(request.answer_in_numbers(), rows); !s.ok()) return s;
  return AnswerLimit(request.max_answer_bytes()).admit(rows * row_bytes, kFewerRows);
}

}  // namespace isofield::rpc
