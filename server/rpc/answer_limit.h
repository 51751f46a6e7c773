// How large the messages of an answer may be, and how much fits into one: the one place that decides it.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isofield::rpc {

// Bytes of a message that gRPC's clients take unless they are told otherwise.
inline constexpr std::uint64_t kDefaultAnswerBytes = 4u << 20;
// Bytes that the parts of meshes and scenes are cut to. What stands beside them in their messages is far less than the
// rest of kDefaultAnswerBytes.
inline constexpr std::uint64_t kPartBytes = 1u << 20;
// Rows of a request or an answer in plain numbers.
inline constexpr std::uint64_t kMaxNumberRows = 4096;

class AnswerLimit {
 public:
  AnswerLimit() = default;
  // `max_answer_bytes` as requests state it: 0 for gRPC's default.
  explicit AnswerLimit(std::uint64_t max_answer_bytes);
  // The same of a stream, whose messages must hold some rows each. INVALID_ARGUMENT: below 64 KiB.
  static absl::StatusOr<AnswerLimit> of_stream(std::uint64_t max_answer_bytes);

  std::uint64_t bytes() const { return bytes_; }
  // How many rows of so many bytes an array may have in a message that holds little else: room for the message's own
  // tags, lengths and shapes is set aside. At least 1.
  std::uint64_t rows(std::uint64_t row_bytes) const;
  // RESOURCE_EXHAUSTED: an answer of at least so many bytes is too large. `instead` says what to do: "ask for fewer
  // rows".
  absl::Status admit(std::uint64_t answer_bytes, absl::string_view instead) const;

 private:
  std::uint64_t bytes_ = kDefaultAnswerBytes;
};

// A list in one message of kDefaultAnswerBytes at most.
class AnswerPage {
 public:
  // Whether an entry of so many bytes has room after those admitted before.
  bool admit(std::uint64_t entry_bytes) {
    constexpr std::uint64_t kEntryHead = 6;  // its tag and length
    bytes_ += entry_bytes + kEntryHead;
    return bytes_ <= kDefaultAnswerBytes;
  }

 private:
  std::uint64_t bytes_ = 2;  // has_more
};

// Calls write(rows) with an array, rows of `columns` numbers, in parts of at most kPartBytes, none where it is empty.
// Returns false as soon as write does.
template <class T, class Write>
bool in_parts(std::span<const T> numbers, std::size_t columns, const Write& write) {
  const std::size_t most = kPartBytes / (columns * sizeof(T)) * columns;
  for (std::size_t at = 0; at < numbers.size(); at += most) {
    if (!write(numbers.subspan(at, std::min(most, numbers.size() - at)))) return false;
  }
  return true;
}

// INVALID_ARGUMENT: plain numbers are asked for, of more rows than are answered so.
absl::Status check_number_rows(bool answer_in_numbers, std::uint64_t rows);

}  // namespace isofield::rpc
