// Reads a configuration file: a TOML file with a line `key = value` for each option.
#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

namespace isofield::daemon {

// One setting of the file. Its key and its value are not checked against the daemon's options here.
struct ConfigLine {
  enum class Kind { kText, kWholeNumber, kNumber, kTruth };

  int line = 0;  // counted from 1
  std::string key;
  Kind kind = Kind::kText;
  std::string value;    // without quotes; whole numbers in decimal digits
  std::string written;  // the value as the file has it
};

// Returns the settings in the order of their lines. NOT_FOUND, PERMISSION_DENIED and others: the file cannot be read.
// INVALID_ARGUMENT: a line is not `key = value` with a string, a number, true or false, or a key occurs twice; the
// message names the file and the line.
absl::StatusOr<std::vector<ConfigLine>> read_config_file(const std::string& path);

}  // namespace isofield::daemon
