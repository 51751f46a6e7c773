#include "points/npy_points.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <cmath>

#include "points/npy_header.h"
#include "points/npy_number.h"
#include "points/point_notes.h"

namespace isofield {
namespace {

// The longest header that is accepted, in bytes. A header that describes one array of numbers has some hundred bytes.
constexpr std::uint32_t kMaxHeader = 65536;
// Arrays of more columns are refused, because they are pictures or have one point in each column.
constexpr std::uint64_t kMostColumns = 64;
constexpr std::size_t kChunkBytes = 1 << 20;

class NpyPoints : public PointReader {
 public:
  explicit NpyPoints(InputFile file) : file_(std::move(file)) {}

  absl::Status read_header(const VectorColumns& wanted);
  absl::Status read(std::size_t max_points, std::vector<float>& xyz) override;
  std::vector<std::string> notes() const override { return point_notes(file_.name(), note_, missed_); }

 private:
  absl::StatusOr<NpyHeader> read_dictionary();
  absl::Status choose_fields(const NpyHeader& header, const VectorColumns& wanted);
  absl::Status choose_columns(const NpyHeader& header, const VectorColumns& wanted);
  absl::Status read_columns(const NpyNumber& number);
  absl::Status read_bytes(std::size_t bytes);
  absl::Status add_point(const char* row, std::vector<float>& xyz);
  absl::Status refuse(absl::string_view what) const {
    return absl::InvalidArgumentError(absl::StrCat(file_.name(), ": ", what));
  }

  InputFile file_;
  // The fields of x, y, z and, if there is one, the distance.
  std::vector<NpyField> chosen_;
  std::size_t row_bytes_ = 0;
  std::uint64_t rows_ = 0;
  std::uint64_t row_ = 0;
  std::vector<char> bytes_;
  // An array in Fortran order is read as a whole: `whole_` then has all its points.
  bool is_whole_ = false;
  std::vector<float> whole_;
  std::string note_;
  std::size_t missed_ = 0;
};

absl::StatusOr<NpyHeader> NpyPoints::read_dictionary() {
  unsigned char start[8];
  const auto got = file_.read(start, 8);
  if (!got.ok()) return got.status();
  if (*got != 8) return refuse("the header is cut off");
  // The length has 2 bytes in version 1, and 4 in versions 2 and 3. It is little-endian, like this machine.
  if (start[6] < 1 || start[6] > 3) return refuse(absl::StrCat("version ", start[6], "; expected 1, 2 or 3"));
  std::uint32_t length = 0;
  const std::size_t length_bytes = start[6] == 1 ? 2 : 4;
  const auto got_length = file_.read(&length, length_bytes);
  if (!got_length.ok()) return got_length.status();
  if (*got_length != length_bytes || length > kMaxHeader) return refuse("the header is damaged");
  std::string dictionary(length, '\0');
  const auto got_dictionary = file_.read(dictionary.data(), length);
  if (!got_dictionary.ok()) return got_dictionary.status();
  if (*got_dictionary != length) return refuse("the header is cut off");
  auto header = parse_npy_header(dictionary);
  if (!header.ok()) return refuse(header.status().message());
  return header;
}

absl::Status NpyPoints::read_header(const VectorColumns& wanted) {
  const auto header = read_dictionary();
  if (!header.ok()) return header.status();
  rows_ = header->shape.empty() ? 0 : header->shape[0];
  if (header->is_structured()) return choose_fields(*header, wanted);
  if (auto status = choose_columns(*header, wanted); !status.ok()) return status;
  return is_whole_ ? read_columns(header->fields[0].number) : absl::OkStatus();
}

absl::Status NpyPoints::choose_fields(const NpyHeader& header, const VectorColumns& wanted) {
  ColumnNames names;
  for (const NpyField& field : header.fields) names.push_back(field.name);
  const auto found = choose_vector(wanted, names, names.size());
  if (!found.ok()) return refuse(found.status().message());
  std::vector<std::size_t> places(found->begin(), found->end());
  if (const auto distance = find_column(names, kDistanceColumn)) places.push_back(*distance);
  for (const std::size_t place : places) {
    if (header.fields[place].number.bytes == 0) {
      return refuse(
          absl::StrCat("the field ", list_names({names[place]}), " holds no numbers; expected integers or floats"));
    }
    chosen_.push_back(header.fields[place]);
  }
  if (header.shape.size() != 1) {
    return refuse(absl::StrCat("shape (", absl::StrJoin(header.shape, ", "), ") of structures; expected (n,)"));
  }
  row_bytes_ = header.item_bytes;
  return absl::OkStatus();
}

absl::Status NpyPoints::choose_columns(const NpyHeader& header, const VectorColumns& wanted) {
  if (header.shape.size() != 2 || header.shape[1] < 3 || header.shape[1] > kMostColumns) {
    return refuse(absl::StrCat("shape (", absl::StrJoin(header.shape, ", "), "); expected (n, 3), or up to ",
                               kMostColumns, " columns of which the first three are x, y, z"));
  }
  const std::size_t columns = header.shape[1];
  const auto found = choose_vector(wanted, {}, columns);
  if (!found.ok()) return refuse(found.status().message());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    NpyField& field = chosen_.emplace_back(header.fields[0]);
    field.offset = (*found)[axis] * header.item_bytes;
  }
  if (columns > 3 && !wanted.is_second) note_ = unnamed_columns_note(columns);
  row_bytes_ = columns * header.item_bytes;
  is_whole_ = header.fortran_order;
  return absl::OkStatus();
}

// Replaces bytes_ by the next `bytes` of the file.
absl::Status NpyPoints::read_bytes(std::size_t bytes) {
  bytes_.resize(bytes);
  const auto got = file_.read(bytes_.data(), bytes);
  if (!got.ok()) return got.status();
  if (*got == bytes) return absl::OkStatus();
  return refuse(absl::StrCat("the file is cut off; its header states ", rows_, " points"));
}

// Reads an array in Fortran order, column after column. Memory grows with the bytes read, since the header may state
// more rows than there are.
absl::Status NpyPoints::read_columns(const NpyNumber& number) {
  const std::size_t first = chosen_[0].offset / number.bytes;
  for (std::size_t column = 0; column < first + 3; ++column) {
    for (std::uint64_t row = 0; row < rows_;) {
      const std::uint64_t count = std::min<std::uint64_t>(kChunkBytes / number.bytes, rows_ - row);
      if (auto status = read_bytes(count * number.bytes); !status.ok()) return status;
      for (std::uint64_t i = 0; column >= first && i < count; ++i) {
        const std::size_t place = 3 * (row + i) + column - first;
        if (column == first) whole_.resize(place + 3);
        whole_[place] = static_cast<float>(read_npy_number(&bytes_[i * number.bytes], number));
        if (!std::isfinite(whole_[place])) {
          return refuse(absl::StrCat("row ", row + i, ": expected finite coordinates that float32 can hold"));
        }
      }
      row += count;
    }
  }
  return absl::OkStatus();
}

absl::Status NpyPoints::add_point(const char* row, std::vector<float>& xyz) {
  if (chosen_.size() > 3 && !std::isfinite(read_npy_number(row + chosen_[3].offset, chosen_[3].number))) {
    ++missed_;
    return absl::OkStatus();
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const NpyField& field = chosen_[axis];
    const float value = static_cast<float>(read_npy_number(row + field.offset, field.number));
    if (!std::isfinite(value)) {
      return refuse(absl::StrCat("row ", row_, ": expected finite coordinates that float32 can hold"));
    }
    xyz.push_back(value);
  }
  return absl::OkStatus();
}

absl::Status NpyPoints::read(std::size_t max_points, std::vector<float>& xyz) {
  const std::size_t full = xyz.size() + 3 * max_points;
  while (xyz.size() < full && row_ < rows_) {
    const std::uint64_t wanted = std::min<std::uint64_t>((full - xyz.size()) / 3, rows_ - row_);
    if (is_whole_) {
      xyz.insert(xyz.end(), whole_.begin() + 3 * row_, whole_.begin() + 3 * (row_ + wanted));
      row_ += wanted;
      continue;
    }
    const std::size_t rows = std::min<std::uint64_t>(std::max<std::size_t>(kChunkBytes / row_bytes_, 1), wanted);
    if (auto status = read_bytes(rows * row_bytes_); !status.ok()) return status;
    for (std::size_t i = 0; i < rows; ++i, ++row_) {
      if (auto status = add_point(&bytes_[i * row_bytes_], xyz); !status.ok()) return status;
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<PointReader>> open_npy_points(InputFile file, const VectorColumns& wanted) {
  auto reader = std::make_unique<NpyPoints>(std::move(file));
  if (auto status = reader->read_header(wanted); !status.ok()) return status;
  return reader;
}

}  // namespace isofield
