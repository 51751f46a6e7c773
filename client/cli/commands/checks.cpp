#include "commands/checks.h"

#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <cmath>
#include <functional>
#include <string>

#include "commands/command_line.h"

namespace isofield {
namespace {

// Makes a check for finite numbers for which `accepts` is true. --help prints `range`, errors print `expected`.
Check number_that(const std::string& expected, const std::string& range, const std::function<bool(double)>& accepts) {
  return {[=](const std::string& text) -> std::string {
            double value = 0;
            if (absl::SimpleAtod(text, &value) && std::isfinite(value) && accepts(value)) return "";
            return absl::StrCat("expected ", expected, ", not ", text.substr(0, 40));
          },
          range};
}

}  // namespace

Check positive() {
  return number_that("a finite number above 0", "above 0", [](double value) { return value > 0; });
}

Check number() {
  return number_that("a finite number", "", [](double) { return true; });
}

Check within(double least, double most) {
  const std::string range = absl::StrCat("within [", least, ", ", most, "]");
  return number_that("a number " + range, range, [=](double value) { return value >= least && value <= most; });
}

Check whole(std::uint64_t least, std::uint64_t most) {
  const std::string range =
      most == UINT64_MAX ? absl::StrCat("at least ", least) : absl::StrCat("within [", least, ", ", most, "]");
  return {[=](const std::string& text) -> std::string {
            std::uint64_t value = 0;
            if (absl::SimpleAtoi(text, &value) && value >= least && value <= most) return "";
            return absl::StrCat("expected a whole number ", range, ", not ", text.substr(0, 40));
          },
          range};
}

}  // namespace isofield
