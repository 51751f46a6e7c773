#pragma once

#include <absl/status/status.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "output_file.h"

namespace isofield {

// A table of results: named columns of numbers or texts, all of the same length. Commands fill it and write it to a
// file.
class Table {
 public:
  // Adds a column of every `stride`-th number from the first, rounded to float32.
  template <class T>
  void add(const std::string& name, std::span<const T> numbers, std::size_t stride = 1) {
    std::vector<float>& column = columns_.emplace_back(Column{name, false, {}, {}}).numbers;
    for (std::size_t i = 0; i < numbers.size(); i += stride) column.push_back(static_cast<float>(numbers[i]));
  }
  // Adds three columns from vectors x, y, z that follow each other.
  void add_vectors(const std::array<std::string, 3>& names, std::span<const float> xyz) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add(names[axis], xyz.empty() ? xyz : xyz.subspan(axis), 3);
    }
  }
  void add_texts(const std::string& name, std::vector<std::string> texts) {
    columns_.push_back({name, true, {}, std::move(texts)});
  }
  std::size_t rows() const { return columns_.empty() ? 0 : columns_[0].size(); }

  // Writes the table in the format that the name's ending tells, and does not commit the file.
  //  - .npy: a NumPy array [rows] of structures, which have a float32 field for each column of numbers, under its name.
  //    Columns of texts are left out.
  //  - .json: an object with an array for each column; infinities and NaN are null.
  //  - Other endings: text with a header. Numbers have nine significant digits, which give a float32 back to the bit.
  absl::Status write(const std::string& path, OutputFile& file) const;

 private:
  struct Column {
    std::string name;
    bool holds_texts;
    std::vector<float> numbers;
    std::vector<std::string> texts;  // instead of numbers

    std::size_t size() const { return holds_texts ? texts.size() : numbers.size(); }
  };
  absl::Status write_csv(OutputFile& file) const;
  absl::Status write_npy(OutputFile& file) const;
  absl::Status write_json(OutputFile& file) const;

  std::vector<Column> columns_;
};

}  // namespace isofield
