// The files that lie beside the checkout, in shared/, and those of the checkout itself, such as golden values.
#pragma once

#include <absl/status/statusor.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace isofield::test_support {

// $ISOFIELD_SHARED, else shared/ beside the checkout; the place alone, whether or not something is there.
std::filesystem::path shared_file(const std::string& name);

// A file of the checkout itself.
std::filesystem::path checkout_file(const std::string& name);

// Whether the file is there; says loudly on stderr that a test is skipped where it is not.
bool has_shared_file(const std::string& name);

// A table of numbers with a line of column names.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  // each as long as `columns`
};
absl::StatusOr<NumberTable> read_csv(const std::filesystem::path& path);

}  // namespace isofield::test_support

// At the start of a test that needs a file of shared/.
#define ISOFIELD_NEEDS_SHARED(name)                                                                           \
  if (!isofield::test_support::has_shared_file(name)) {                                                       \
    GTEST_SKIP() << isofield::test_support::shared_file(name).string() << " is missing; set ISOFIELD_SHARED"; \
  }                                                                                                           \
  static_assert(true)
