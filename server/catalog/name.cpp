#include "catalog/name.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <algorithm>

#include "base/quoted.h"

namespace isofield::catalog {

absl::Status check_name(const std::string& name) {
  const bool is_name =
      !name.empty() && name.size() <= 128 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return absl::ascii_isalnum(c) || c == '_' || c == '-' || c == '.' || c == '/';
      });
  if (is_name) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("name = ", base::quoted(name), ": expected 1 to 128 characters of A-Z a-z 0-9 _ - . /"));
}

}  // namespace isofield::catalog
