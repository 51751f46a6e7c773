#include "tables/cells.h"

#include <absl/strings/ascii.h>

#include <algorithm>
#include <cstring>

#include "tables/number.h"

namespace isofield {
namespace {

constexpr absl::string_view kAnySeparator = " \t,;\v\f\r";

bool is_any_separator(char c) {
  return kAnySeparator.find(c) != absl::string_view::npos;
}

std::size_t count_outside_quotes(absl::string_view line, char wanted) {
  std::size_t count = 0;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) ++count;
  }
  return count;
}

}  // namespace

Separator find_separator(absl::string_view line) {
  line = absl::StripAsciiWhitespace(line);
  const std::size_t semicolons = count_outside_quotes(line, ';');
  const std::size_t commas = count_outside_quotes(line, ',');
  const std::size_t tabs = count_outside_quotes(line, '\t');
  // Commas in a line of several semicolons are decimal commas. A single semicolon among commas belongs to a text.
  if (semicolons > 1 || (semicolons > 0 && commas == 0)) return ';';
  // If there are at least as many commas as tabs, the commas separate the cells and the tabs are blanks around them.
  if (commas > 0 && tabs <= commas) return ',';
  if (tabs == 0) return kBlanks;
  // Names that tabs separate may have blanks in them, but numbers have none.
  const bool mixed = count_outside_quotes(line, ' ') > 0 && cell_number(split_cells(line, kBlanks)[0], kBlanks);
  return mixed ? kBlanks : '\t';
}

const char* cell_end(const char* begin, const char* end, Separator separator) {
  const char* at = begin;
  while (at != end && (*at == ' ' || (*at == '\t' && separator != '\t'))) ++at;
  if (at != end && *at == '"') {
    // A doubled quote closes the quotes and opens them again, which gives the same end.
    bool quoted = false;
    for (; at != end && (quoted || *at != separator); ++at) quoted = quoted != (*at == '"');
    return at;
  }
  const void* const found = at == end ? nullptr : std::memchr(at, separator, static_cast<std::size_t>(end - at));
  return found ? static_cast<const char*>(found) : end;
}

absl::string_view bare_cell(absl::string_view cell) {
  cell = absl::StripAsciiWhitespace(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = absl::StripAsciiWhitespace(cell.substr(1, cell.size() - 2));
  }
  return cell;
}

std::vector<absl::string_view> split_cells(absl::string_view line, Separator separator) {
  std::vector<absl::string_view> cells;
  const char* at = line.data();
  const char* const end = at + line.size();
  if (separator != kBlanks) {
    while (true) {
      const char* const stop = cell_end(at, end, separator);
      cells.push_back(bare_cell({at, static_cast<std::size_t>(stop - at)}));
      if (stop == end) return cells;
      at = stop + 1;
    }
  }
  while (true) {
    while (at != end && is_any_separator(*at)) ++at;
    if (at == end) return cells;
    const char* stop = at;
    bool quoted = false;
    for (; stop != end && (quoted || !is_any_separator(*stop)); ++stop) quoted = quoted != (*stop == '"');
    cells.push_back(bare_cell({at, static_cast<std::size_t>(stop - at)}));
    at = stop;
  }
}

std::optional<double> cell_number(absl::string_view cell, Separator separator) {
  return separator == ';' ? parse_decimal_comma(cell) : parse_double(cell);
}

}  // namespace isofield
