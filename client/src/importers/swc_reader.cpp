#include "importers/swc_reader.h"

#include <absl/container/flat_hash_set.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <absl/strings/str_split.h>

#include <algorithm>
#include <cmath>

#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

constexpr std::size_t kColumns = 7;
// The largest coordinate. The server takes segments up to kLargestLength, and two points within these coordinates are
// at most 0.87 of it apart.
constexpr double kFarthest = kLargestLength / 4;
enum Column { kId, kType, kX, kRadius = 5, kParent };

// Returns the part of a line before a comment.
absl::string_view without_comment(absl::string_view line) {
  return line.substr(0, line.find('#'));
}

// Returns true where blanks or semicolons separate enough fields and one of these has a comma inside, which is then a
// decimal comma.
bool has_decimal_commas(absl::string_view data) {
  const std::vector<absl::string_view> fields = absl::StrSplit(data, absl::ByAnyChar(" \t;"), absl::SkipEmpty());
  return fields.size() >= kColumns && std::any_of(fields.begin(), fields.end(), [](absl::string_view field) {
           const std::size_t comma = field.find(',');
           return comma != absl::string_view::npos && comma > 0 && comma + 1 < field.size();
         });
}

std::string piece_id(SwcId id) {
  return id < 0 ? absl::StrCat(static_cast<std::int64_t>(id)) : absl::StrCat(static_cast<std::uint64_t>(id));
}

class SampleReader {
 public:
  SampleReader(const glm::dvec3& scale, ImportReport& report)
      : scale_(scale),
        radius_scale_(std::cbrt(scale[0]) * std::cbrt(scale[1]) * std::cbrt(scale[2])),
        report_(report) {}

  void read(absl::string_view line, std::size_t number) {
    const absl::string_view data = without_comment(line);
    if (data.find_first_not_of(" \t,;") == absl::string_view::npos) return;
    ++report_.read;
    number_ = number;
    line_ = line;
    if (has_decimal_commas(data)) {
      remark("decimal commas were read as points");
      read_fields(split_fields(absl::StrReplaceAll(data, {{",", "."}})));
    } else {
      read_fields(split_fields(data));
    }
  }

  std::vector<SwcSample> take() { return std::move(samples_); }

 private:
  void damage(absl::string_view what) { note(report_, what, number_, line_); }
  void remark(absl::string_view what) { note(report_, what, number_, line_, false); }

  void read_fields(const std::vector<absl::string_view>& fields) {
    if (fields.size() < kColumns) return damage("line dropped: expected \"id type x y z radius parent\"");
    const auto id = parse_integer64(fields[kId]);
    if (!id) {
      return damage(parse_double(fields[kId]) ? "line dropped: its id is not a whole number of at most 64 bits"
                                              : "line dropped: expected \"id type x y z radius parent\"");
    }
    if (fields.size() > kColumns) remark("line with more than 7 columns: the others are ignored");
    SwcSample sample;
    sample.id = *id;
    sample.line_number = number_;
    sample.line = line_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto coordinate = parse_double(fields[kX + axis]);
      sample.center[axis] = coordinate.value_or(NAN) * scale_[axis];
      if (!(std::abs(sample.center[axis]) <= kFarthest)) {
        return damage(
            absl::StrCat("sample dropped: a coordinate is not a finite number of a usable size (magnitude at "
                         "most ",
                         kFarthest, ")"));
      }
    }
    if (!ids_.insert(*id).second) return damage("sample dropped: its id was used before");
    const auto type = parse_integer(fields[kType]);
    if (!type) damage("sample given the type 0 (undefined): its type is not a whole number");
    sample.type = type.value_or(0);
    const double radius = parse_double(fields[kRadius]).value_or(NAN) * radius_scale_;
    sample.radius = radius >= kLeastLength && radius <= kFarthest ? radius : 0;
    const auto parent = parse_integer64(fields[kParent]);
    if (!parent) damage("sample made a root: its parent is not a whole number of at most 64 bits");
    sample.parent_id = parent.value_or(-1);
    samples_.push_back(sample);
  }

  const glm::dvec3 scale_;
  const double radius_scale_;
  ImportReport& report_;
  std::vector<SwcSample> samples_;
  absl::flat_hash_set<SwcId> ids_;
  std::size_t number_ = 0;
  absl::string_view line_;
};

}  // namespace

std::string piece_name(const SwcSample& sample) {
  return absl::StrCat("n", piece_id(sample.id));
}

std::vector<SwcSample> read_swc_samples(const std::string& text, const glm::dvec3& scale, ImportReport& report) {
  SampleReader reader(scale, report);
  LineReader lines(text);
  absl::string_view line;
  while (lines.next(line)) reader.read(line, lines.number());
  return reader.take();
}

}  // namespace isofield
