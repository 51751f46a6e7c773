// Finds the files that lie beside the checkout, in shared/, and those of the checkout itself, such as golden values.
// Reads tables of numbers.
#pragma once

#include <absl/status/statusor.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace isofield::test_support {

// Returns the path of a file in $ISOFIELD_SHARED, or else in shared/ beside the checkout. The file need not exist.
std::filesystem::path shared_file(const std::string& name);

// Returns the path of a file of the checkout itself.
std::filesystem::path checkout_file(const std::string& name);

// Returns whether the file exists. If it does not, a line on stderr says that a test is skipped.
bool has_shared_file(const std::string& name);

// A table of numbers with a line of column names.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  // each as long as `columns`
};
// Reads a CSV file. Fails with NotFound if it can't be opened, and with InvalidArgument for a row that does not hold a
// number for each column.
absl::StatusOr<NumberTable> read_csv(const std::filesystem::path& path);

}  // namespace isofield::test_support

// A test that needs a file of shared/ begins with this macro. It skips the test if the file is missing.
#define ISOFIELD_NEEDS_SHARED(name)                                                                           \
  if (!isofield::test_support::has_shared_file(name)) {                                                       \
    GTEST_SKIP() << isofield::test_support::shared_file(name).string() << " is missing; set ISOFIELD_SHARED"; \
  }                                                                                                           \
  static_assert(true)
