// Unpacks gzip files.
#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <string>

namespace isofield {

// The most bytes that a packed file may hold, so that a small file cannot fill the memory.
inline constexpr std::size_t kMostUnpackedBytes = std::size_t{4} << 30;

// Returns the name without the ending .gz, in either case of letters, if it has this ending: the name of the file that
// was packed.
absl::string_view unpacked_name(absl::string_view name);

// Returns true where the data begins with the two bytes that mark a gzip file.
bool is_gzip(absl::string_view data);

// Unpacks all members of a gzip file, one after the other. INVALID_ARGUMENT: it is damaged or ends early.
// RESOURCE_EXHAUSTED: it holds more than `limit` bytes.
absl::StatusOr<std::string> gunzip(absl::string_view data, std::size_t limit = kMostUnpackedBytes);

}  // namespace isofield
