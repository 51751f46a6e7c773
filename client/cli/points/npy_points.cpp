#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>
#include <absl/strings/string_view.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "points/input_file.h"
#include "points/point_reader.h"

namespace isofield {
namespace {

constexpr absl::string_view kMagic("\x93NUMPY", 6);
// A header that describes one array of numbers has some hundred bytes.
constexpr std::uint32_t kMaxHeader = 65536;

// The text between `key` and the comma or brace after it; of a tuple, its inside.
absl::string_view header_value(absl::string_view header, absl::string_view key) {
  const std::size_t at = header.find(key);
  if (at == absl::string_view::npos) return {};
  absl::string_view value = header.substr(at + key.size());
  const std::size_t start = value.find_first_not_of(" :");
  if (start == absl::string_view::npos) return {};
  value.remove_prefix(start);
  return value.front() == '(' ? value.substr(1, value.find(')') - 1) : value.substr(0, value.find_first_of(",}"));
}

class NpyPoints : public PointReader {
 public:
  NpyPoints(InputFile file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}

  absl::Status read_header() {
    unsigned char start[8];
    if (std::fread(start, 1, 8, file_.get()) != 8 || std::memcmp(start, kMagic.data(), 6) != 0) {
      return refuse("not a NumPy array file (.npy)");
    }
    // The length has 2 bytes in version 1, and 4 in versions 2 and 3; little-endian, as we are.
    const std::size_t length_bytes = start[6] == 1 ? 2 : 4;
    std::uint32_t length = 0;
    if (start[6] < 1 || start[6] > 3) return refuse(absl::StrCat("version ", start[6], "; expected 1, 2 or 3"));
    if (std::fread(&length, 1, length_bytes, file_.get()) != length_bytes || length > kMaxHeader) {
      return refuse("the header is damaged");
    }
    std::string header(length, '\0');
    if (std::fread(header.data(), 1, length, file_.get()) != length) return refuse("the header is cut off");

    const absl::string_view type = header_value(header, "'descr'");
    if (type == "'<f4'") {
      item_bytes_ = 4;
    } else if (type == "'<f8'") {
      item_bytes_ = 8;
    } else {
      return refuse(absl::StrCat("dtype ", type, "; expected '<f4' or '<f8' (float32 or float64)"));
    }
    if (header_value(header, "'fortran_order'") != "False") {
      return refuse("Fortran order; expected C order (numpy.ascontiguousarray)");
    }
    const absl::string_view shape = header_value(header, "'shape'");
    const std::vector<absl::string_view> dimensions = absl::StrSplit(shape, ',', absl::SkipWhitespace());
    std::uint64_t columns = 0;
    if (dimensions.size() != 2 || !absl::SimpleAtoi(dimensions[0], &rows_) ||
        !absl::SimpleAtoi(dimensions[1], &columns) || columns != 3) {
      return refuse(absl::StrCat("shape (", shape, "); expected (n, 3)"));
    }
    return absl::OkStatus();
  }

  absl::Status read(std::size_t max_points, std::vector<float>& xyz) override {
    const std::size_t points = std::min<std::uint64_t>(max_points, rows_ - row_);
    bytes_.resize(3 * points * item_bytes_);
    if (points > 0 && std::fread(bytes_.data(), 1, bytes_.size(), file_.get()) != bytes_.size()) {
      if (std::ferror(file_.get())) return absl::ErrnoToStatus(errno, name_);
      return refuse(absl::StrCat("the file is cut off; its header states ", rows_, " points"));
    }
    for (std::size_t i = 0; i < 3 * points; ++i) {
      float value = 0;
      if (item_bytes_ == 4) {
        std::memcpy(&value, &bytes_[4 * i], 4);
      } else {
        double wide = 0;
        std::memcpy(&wide, &bytes_[8 * i], 8);
        value = static_cast<float>(wide);
      }
      if (!std::isfinite(value)) {
        return refuse(absl::StrCat("row ", row_ + i / 3, ": expected finite coordinates that float32 can hold"));
      }
      xyz.push_back(value);
    }
    row_ += points;
    return absl::OkStatus();
  }

 private:
  absl::Status refuse(const std::string& what) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ": ", what));
  }

  InputFile file_;
  const std::string name_;
  std::size_t item_bytes_ = 0;
  std::uint64_t rows_ = 0;
  std::uint64_t row_ = 0;
  std::vector<char> bytes_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<PointReader>> open_npy_points(const std::string& path) {
  InputFile file(std::fopen(path.c_str(), "rb"));
  if (!file) return absl::ErrnoToStatus(errno, path);
  auto reader = std::make_unique<NpyPoints>(std::move(file), path);
  if (auto status = reader->read_header(); !status.ok()) return status;
  return reader;
}

}  // namespace isofield
