#include <absl/strings/string_view.h>

#include <charconv>
#include <cmath>

#include "points/line_reader.h"
#include "points/point_reader.h"

namespace isofield {
namespace {

bool is_separator(char c) {
  return c == ' ' || c == ',' || c == '\t' || c == ';' || c == '\r';
}

// The number at the start of `rest`, which is then advanced past it and the separators that follow. False: none.
bool take_number(absl::string_view& rest, double& value) {
  const char* begin = rest.data();
  const char* const end = begin + rest.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    value = HUGE_VAL;
  } else if (error != std::errc()) {
    return false;
  }
  if (after != end && !is_separator(*after)) return false;
  const char* next = after;
  while (next != end && is_separator(*next)) ++next;
  rest = absl::string_view(next, static_cast<std::size_t>(end - next));
  return true;
}

class CsvPoints : public PointReader {
 public:
  explicit CsvPoints(std::unique_ptr<LineReader> lines) : lines_(std::move(lines)) {}

  absl::Status read(std::size_t max_points, std::vector<float>& xyz) override {
    const std::size_t full = xyz.size() + 3 * max_points;
    absl::string_view line;
    while (xyz.size() < full) {
      const auto got = lines_->next(line, "\"x,y,z\"");
      if (!got.ok()) return got.status();
      if (!*got) break;
      if (auto status = parse(line, xyz); !status.ok()) return status;
    }
    return absl::OkStatus();
  }

 private:
  absl::Status parse(absl::string_view line, std::vector<float>& xyz) {
    absl::string_view rest = line;
    while (!rest.empty() && is_separator(rest.front())) rest.remove_prefix(1);
    if (rest.empty() || rest.front() == '#') return absl::OkStatus();
    const bool first = !seen_content_;
    seen_content_ = true;
    for (int axis = 0; axis < 3; ++axis) {
      double value = 0;
      if (!take_number(rest, value)) {
        if (first && axis == 0) {
          has_header_ = true;
          return absl::OkStatus();
        }
        return lines_->refuse(line, "expected three numbers x,y,z");
      }
      // Rounded to float32, as the server computes; 1e39 would become infinite there.
      const float rounded = static_cast<float>(value);
      if (!std::isfinite(rounded)) return lines_->refuse(line, "expected finite coordinates that float32 can hold");
      xyz.push_back(rounded);
    }
    if (!rest.empty() && !has_header_) {
      return lines_->refuse(line, "expected three numbers x,y,z and no more (a header line allows further columns)");
    }
    return absl::OkStatus();
  }

  std::unique_ptr<LineReader> lines_;
  bool seen_content_ = false;
  bool has_header_ = false;
};

}  // namespace

absl::StatusOr<std::unique_ptr<PointReader>> open_csv_points(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines.ok()) return lines.status();
  return std::make_unique<CsvPoints>(*std::move(lines));
}

}  // namespace isofield
