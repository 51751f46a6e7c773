#pragma once

#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <vector>

#include "points/file_lines.h"
#include "tables/table_head.h"

namespace isofield {

// Reads a text of numbers in named columns: a header line, then one line for each row. Cells are separated by commas,
// semicolons, tabs or blanks; decimal commas are read between semicolons only (tables/table_head.h). It is
// single-threaded.
class ArgumentTable {
 public:
  // Opens the file and reads the header. INVALID_ARGUMENT: there is no header. NOT_FOUND ...: the file cannot be read.
  static absl::StatusOr<std::unique_ptr<ArgumentTable>> open(const std::string& path);

  // The names of the columns, in lower case.
  const std::vector<std::string>& header() const { return header_; }
  // Chooses the columns that read() returns, by their places in the header. The other columns may hold anything.
  void choose(std::vector<std::size_t> places) { places_ = std::move(places); }
  // Appends up to max_rows rows of the chosen columns; fewer only at the end. INVALID_ARGUMENT: a row cannot be read;
  // the message names the line and what is wrong in it.
  absl::Status read(std::size_t max_rows, std::vector<float>& numbers);

  // The place of the header, for errors: "points.csv:1".
  const std::string& place() const { return place_; }

 private:
  explicit ArgumentTable(InputFile file) : lines_(std::move(file)) {}
  absl::Status read_header();
  // Splits the next row into cells_; returns false at the end. Skips blank lines and comments.
  absl::StatusOr<bool> next_cells();
  absl::Status parse_row(std::vector<float>& numbers) const;

  FileLines lines_;
  TableHead head_;
  bool has_row_ = false;
  std::vector<std::string> header_;
  std::string place_;
  std::vector<std::size_t> places_;
  std::vector<absl::string_view> cells_;
};

}  // namespace isofield
