#include "importers/cif_lines.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <algorithm>

#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

constexpr int kDamaged = -1;

bool is_keyword(absl::string_view value) {
  for (const char* keyword : {"data_", "loop_", "global_", "save_", "stop_"}) {
    if (absl::StartsWithIgnoreCase(value, keyword)) return true;
  }
  return false;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Counts the values in a line. Returns kDamaged where a quote does not end, or where the line has what CIF does not
// allow there.
int count_values(absl::string_view line) {
  int values = 0;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) < line.size()) {
    const char quote = line[at];
    if (quote == '#') break;
    std::size_t end = at + 1;
    if (quote == '"' || quote == '\'') {
      // A quote ends where a blank follows it.
      while (end < line.size() && !(line[end] == quote && (end + 1 == line.size() || is_blank(line[end + 1])))) ++end;
      if (end == line.size()) return kDamaged;
      ++end;
    } else {
      end = std::min(line.size(), line.find_first_of(" \t", at));
      if (quote == '_' || quote == '$' || is_keyword(line.substr(at, end - at))) return kDamaged;
    }
    ++values;
    at = end;
  }
  const bool printable =
      std::all_of(line.begin(), line.end(), [](unsigned char c) { return absl::ascii_isprint(c) || c == '\t'; });
  return printable ? values : kDamaged;
}

// Copies a text line by line without the damaged lines of its atoms.
class CifMender {
 public:
  explicit CifMender(ImportReport& report) : report_(report) {}

  CifLines mend(const std::string& text) {
    LineReader lines(text);
    for (absl::string_view line; lines.next_raw(line);) {
      if (keeps(line, lines.number())) absl::StrAppend(&result_.text, line);
      result_.text += '\n';
    }
    end_atoms();
    return std::move(result_);
  }

 private:
  enum class Place { kElsewhere, kText, kLoop, kAtomTags, kAtoms };

  // Returns true where the line stays, and notes which part of the file the next line belongs to.
  bool keeps(absl::string_view line, std::size_t number) {
    const bool begins_text = absl::StartsWith(line, ";");
    const absl::string_view content = absl::StripAsciiWhitespace(line);
    if (place_ == Place::kText) {
      if (begins_text) place_ = Place::kElsewhere;
      return true;
    }
    if (place_ == Place::kAtomTags || place_ == Place::kAtoms) {
      if (content.empty() || content[0] == '#') return true;
      if (content[0] == '_' && place_ == Place::kAtomTags) {
        ++width_;
        return true;
      }
      if (content[0] != '_' && !begins_text && !is_keyword(content)) return keeps_atom(content, number);
      end_atoms();
      if (begins_text) one_a_line_ = false;
    }
    if (begins_text) {
      place_ = Place::kText;
    } else if (absl::EqualsIgnoreCase(content, "loop_")) {
      place_ = Place::kLoop;
    } else if (place_ == Place::kLoop && absl::StartsWithIgnoreCase(content, "_atom_site.") && !found_) {
      place_ = Place::kAtomTags;
      found_ = true;
      width_ = 1;
    } else if (!content.empty()) {
      place_ = Place::kElsewhere;
    }
    return true;
  }

  bool keeps_atom(absl::string_view content, std::size_t number) {
    const int values = count_values(content);
    if (place_ == Place::kAtomTags) {
      place_ = Place::kAtoms;
      // Atoms that take two lines each are left to the reader.
      one_a_line_ = values == kDamaged || values >= width_;
    }
    if (!one_a_line_) return true;
    if (values == width_) {
      result_.atoms.push_back({number, content});
      return true;
    }
    ++report_.read;
    note(report_, absl::StrCat("atom dropped: its line does not have one value for each of the ", width_, " columns"),
         number, content);
    return false;
  }

  void end_atoms() {
    place_ = Place::kElsewhere;
    if (!one_a_line_) result_.atoms.clear();
  }

  ImportReport& report_;
  CifLines result_;
  Place place_ = Place::kElsewhere;
  bool found_ = false;
  bool one_a_line_ = true;
  int width_ = 0;
};

}  // namespace

CifLines mend_cif(const std::string& text, ImportReport& report) {
  return CifMender(report).mend(text);
}

}  // namespace isofield
