// Unpacks gzip files.
#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <string>

namespace isofield {

// The most bytes that a packed file may hold, so that a small file cannot fill the memory.
inline constexpr std::size_t kMostUnpackedBytes = std::size_t{4} << 30;

// Returns true where the data begins with the two bytes that mark a gzip file.
bool is_gzip(absl::string_view data);

// Unpacks all members of a gzip file, one after the other. INVALID_ARGUMENT: it is damaged or ends early.
// RESOURCE_EXHAUSTED: it holds more than `limit` bytes.
absl::StatusOr<std::string> gunzip(absl::string_view data, std::size_t limit = kMostUnpackedBytes);

}  // namespace isofield
