// A configuration file: lines `key = value` of TOML, one for each option.
#pragma once

#include <absl/status/statusor.h>

#include <string>
#include <vector>

namespace isofield::daemon {

struct ConfigLine {
  enum class Kind { kText, kWholeNumber, kNumber, kTruth };

  int line = 0;  // from 1
  std::string key;
  Kind kind = Kind::kText;
  std::string value;    // without quotes; whole numbers in decimal digits
  std::string written;  // as the file has it
};

// NOT_FOUND, PERMISSION_DENIED ...: the file cannot be read. INVALID_ARGUMENT: a line is none of TOML's `key = value`
// with a string, a number, true or false, or a key stands there twice; the message names the file and the line.
absl::StatusOr<std::vector<ConfigLine>> read_config_file(const std::string& path);

}  // namespace isofield::daemon
