#include "importers/swc_scale.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/strip.h>

#include <optional>
#include <vector>

#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

// Returns the fields after the word SCALE of a header line, or nothing for any other line. Where "scale" is not in
// capitals, a number must follow, since the comment may be prose.
std::optional<std::vector<absl::string_view>> scale_fields(absl::string_view line) {
  if (!absl::ConsumePrefix(&line, "#")) return std::nullopt;
  while (absl::ConsumePrefix(&line, "#")) continue;
  line = absl::StripLeadingAsciiWhitespace(line);
  if (!absl::StartsWithIgnoreCase(line, "scale")) return std::nullopt;
  const bool is_header_word = absl::StartsWith(line, "SCALE");
  line.remove_prefix(5);
  if (!line.empty() && !absl::ascii_isspace(line.front()) && line.front() != ':' && line.front() != '=') {
    return std::nullopt;
  }
  line = absl::StripLeadingAsciiWhitespace(line);
  if (!line.empty() && (line.front() == ':' || line.front() == '=')) line.remove_prefix(1);
  const auto fields = split_fields(line);
  // Some programs write the header with an empty value, which means nothing.
  if (fields.empty() || (!is_header_word && !parse_double(fields[0]))) return std::nullopt;
  return fields;
}

std::optional<glm::dvec3> parse_factors(const std::vector<absl::string_view>& fields) {
  if (fields.size() < 3) return std::nullopt;
  glm::dvec3 factors;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto factor = parse_double(fields[axis]);
    if (!factor || !(*factor >= kLeastLength && *factor <= kLargestLength)) return std::nullopt;
    factors[axis] = *factor;
  }
  return factors;
}

}  // namespace

glm::dvec3 read_swc_scale(const std::string& text, bool apply, ImportReport& report) {
  constexpr glm::dvec3 kNone = {1, 1, 1};
  std::optional<glm::dvec3> stated;
  bool malformed = false;
  LineReader lines(text);
  absl::string_view line;
  while (lines.next(line)) {
    const auto fields = scale_fields(line);
    if (!fields) continue;
    const auto factors = parse_factors(*fields);
    if (!factors) {
      malformed = true;
      note(report, "line SCALE of the header ignored: expected \"# SCALE x y z\" with three numbers > 0",
           lines.number(), line);
    } else if (stated) {
      note(report, "further line SCALE of the header ignored: the first one counts", lines.number(), line,
           *factors != *stated);
    } else {
      stated = factors;
      if (*factors == kNone) continue;
      const std::string values = absl::StrCat((*factors)[0], " ", (*factors)[1], " ", (*factors)[2]);
      note(report,
           apply ? absl::StrCat("the header states SCALE ", values,
                                ": coordinates are multiplied by it, radii by the geometric mean of the three")
                 : absl::StrCat("the header states SCALE ", values,
                                ": it is not applied; the import option apply_scale multiplies the lengths by it"),
           lines.number(), line, false);
    }
  }
  if (apply && !stated && !malformed) {
    note(report, "the import option apply_scale changes nothing: the header has no line \"# SCALE x y z\"", 1, "",
         false);
  }
  return apply ? stated.value_or(kNone) : kNone;
}

}  // namespace isofield
