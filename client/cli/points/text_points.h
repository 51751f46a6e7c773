#pragma once

#include <optional>

#include "points/file_lines.h"
#include "points/point_reader.h"
#include "tables/row_numbers.h"

namespace isofield {

// Reads points from a text, as open_points() describes.
class TextPoints : public PointReader {
 public:
  TextPoints(InputFile file, const VectorColumns& wanted) : lines_(std::move(file)), wanted_(wanted) {}

  absl::Status read(std::size_t max_points, std::vector<float>& xyz) override;
  std::vector<std::string> notes() const override;

 private:
  // Reads up to the first row, and sets `line` to it. Returns false if there is no row.
  absl::StatusOr<bool> read_head(absl::string_view& line);
  absl::Status choose_columns(const class TableHead& head, absl::string_view row);
  absl::Status parse(absl::string_view line, std::vector<float>& xyz);

  FileLines lines_;
  const VectorColumns wanted_;
  std::optional<RowNumbers> numbers_;  // empty until the head is read
  bool has_distance_ = false;
  std::string note_;
  std::size_t missed_ = 0;
};

}  // namespace isofield
