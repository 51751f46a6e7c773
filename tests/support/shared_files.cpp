#include "support/shared_files.h"

#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace isofield::test_support {

std::filesystem::path shared_file(const std::string& name) {
  const char* const stated = std::getenv("ISOFIELD_SHARED");
  const std::filesystem::path shared =
      stated != nullptr ? std::filesystem::path(stated) : std::filesystem::path(ISOFIELD_CHECKOUT) / ".." / "shared";
  return (shared / name).lexically_normal();
}

std::filesystem::path checkout_file(const std::string& name) {
  return std::filesystem::path(ISOFIELD_CHECKOUT) / name;
}

bool has_shared_file(const std::string& name) {
  const std::filesystem::path path = shared_file(name);
  if (std::filesystem::exists(path)) return true;
  std::fprintf(stderr, "\n******** SKIPPED, NOT PASSED: %s is missing (set ISOFIELD_SHARED) ********\n\n",
               path.c_str());
  return false;
}

absl::StatusOr<NumberTable> read_csv(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) return absl::NotFoundError(absl::StrCat(path.string(), " can't be opened"));
  NumberTable table;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    const std::vector<std::string> cells = absl::StrSplit(line, ',');
    if (table.columns.empty()) {
      table.columns = cells;
      continue;
    }
    std::vector<double>& row = table.rows.emplace_back(cells.size());
    bool ok = cells.size() == table.columns.size();
    for (std::size_t i = 0; i < cells.size(); ++i) ok = absl::SimpleAtod(cells[i], &row[i]) && ok;
    if (!ok) {
      return absl::InvalidArgumentError(
          absl::StrCat(path.string(), ":", number, ": '", line, "': expected ", table.columns.size(), " numbers"));
    }
  }
  return table;
}

}  // namespace isofield::test_support
