#include "importers/import_report.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "importers/text.h"

namespace isofield {
namespace {

constexpr std::size_t kExamples = 3;

}  // namespace

void note(ImportReport& report, absl::string_view what, std::size_t line_number, absl::string_view line, bool damage) {
  auto finding = std::find_if(report.findings.begin(), report.findings.end(),
                              [&](const ImportReport::Finding& known) { return known.what == what; });
  if (finding == report.findings.end()) {
    finding = report.findings.insert(finding, ImportReport::Finding{std::string(what), 0, {}, damage});
  }
  if (++finding->count > kExamples || (line_number == 0 && line.empty())) return;
  finding->examples.push_back(line_number > 0 ? quote_line(line_number, line) : absl::StrCat("entry ", line));
}

bool ImportReport::damaged() const {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.damage; });
}

std::string ImportReport::text() const {
  std::string out = absl::StrCat(format, ": ", read, " read, ", pieces, " pieces made\n");
  for (const Finding& finding : findings) {
    absl::StrAppend(&out, "  ", finding.count, " x ", finding.what, "\n");
    if (!finding.damage) continue;
    for (const std::string& example : finding.examples) absl::StrAppend(&out, "      ", example, "\n");
    if (finding.count > finding.examples.size()) absl::StrAppend(&out, "      ...\n");
  }
  return out;
}

}  // namespace isofield
