#include <absl/strings/str_cat.h>
#include <absl/strings/string_view.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "points/input_file.h"
#include "points/point_reader.h"

namespace isofield {
namespace {

constexpr std::size_t kBlockBytes = 1 << 20;

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
  CsvPoints(InputFile file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}

  absl::Status read(std::size_t max_points, std::vector<float>& xyz) override {
    const std::size_t full = xyz.size() + 3 * max_points;
    absl::string_view line;
    while (xyz.size() < full) {
      const auto got = next_line(line);
      if (!got.ok()) return got.status();
      if (!*got) break;
      if (auto status = parse(line, xyz); !status.ok()) return status;
    }
    return absl::OkStatus();
  }

 private:
  // False at the end. The line lives until the next call.
  absl::StatusOr<bool> next_line(absl::string_view& line) {
    while (true) {
      const char* begin = block_.data() + begin_;
      const void* end = begin_ < end_ ? std::memchr(begin, '\n', end_ - begin_) : nullptr;
      if (end != nullptr || (at_end_ && begin_ < end_)) {
        const std::size_t length = end != nullptr ? static_cast<const char*>(end) - begin : end_ - begin_;
        line = absl::string_view(begin, length);
        begin_ += length + (end != nullptr ? 1 : 0);
        ++line_number_;
        return true;
      }
      if (at_end_) return false;
      if (auto status = fill(); !status.ok()) return status;
    }
  }

  // Moves the rest of the block to its start and reads more behind it.
  absl::Status fill() {
    std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    if (end_ == block_.size()) {
      return absl::InvalidArgumentError(
          absl::StrCat(name_, ":", line_number_ + 1, ": a line longer than 1 MiB; expected \"x,y,z\""));
    }
    const std::size_t got = std::fread(block_.data() + end_, 1, block_.size() - end_, file_.get());
    end_ += got;
    if (got == 0) {
      if (std::ferror(file_.get())) return absl::ErrnoToStatus(errno, name_);
      at_end_ = true;
    }
    return absl::OkStatus();
  }

  absl::Status parse(absl::string_view line, std::vector<float>& xyz) {
    if (line_number_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
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
        return refuse(line, "expected three numbers x,y,z");
      }
      // Rounded to float32, as the server computes; 1e39 would become infinite there.
      const float rounded = static_cast<float>(value);
      if (!std::isfinite(rounded)) return refuse(line, "expected finite coordinates that float32 can hold");
      xyz.push_back(rounded);
    }
    if (!rest.empty() && !has_header_) {
      return refuse(line, "expected three numbers x,y,z and no more (a header line allows further columns)");
    }
    return absl::OkStatus();
  }

  absl::Status refuse(absl::string_view line, const char* expected) const {
    return absl::InvalidArgumentError(
        absl::StrCat(name_, ":", line_number_, ": \"", line.substr(0, 60), "\": ", expected));
  }

  InputFile file_;
  const std::string name_;
  std::vector<char> block_ = std::vector<char>(kBlockBytes);
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t line_number_ = 0;
  bool at_end_ = false;
  bool seen_content_ = false;
  bool has_header_ = false;
};

}  // namespace

absl::StatusOr<std::unique_ptr<PointReader>> open_csv_points(const std::string& path) {
  InputFile file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) return absl::ErrnoToStatus(errno, path);
  return std::make_unique<CsvPoints>(std::move(file), path == "-" ? "<stdin>" : path);
}

}  // namespace isofield
