#include "commands/catalog_listing.h"

#include <absl/strings/str_format.h>

namespace isofield {
namespace {

template <class Text>
void print_row(const std::vector<ListingColumn>& columns, const Text& text) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    absl::StrAppendFormat(&line, "%s%*s", i > 0 ? " " : "", columns[i].width, text(i));
  }
  std::printf("%s\n", line.c_str());
}

}  // namespace

void print_listing(const std::vector<ListingColumn>& columns, const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return;
  print_row(columns, [&](std::size_t i) { return columns[i].name; });
  for (const auto& row : rows) {
    print_row(columns, [&](std::size_t i) -> const std::string& { return row[i]; });
  }
}

void print_deleted(const Context& context, const std::string& name) {
  if (context.json) {
    JsonObject().set("deleted", name).print();
  } else {
    std::printf("%s: deleted\n", name.c_str());
  }
}

}  // namespace isofield
