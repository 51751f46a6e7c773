#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isofield {

// One number of an array's element: how it is stored, and where.
struct NpyNumber {
  char kind = 'f';  // 'f': IEEE float, 'i': signed, 'u': unsigned
  std::size_t bytes = 4;
  bool big_endian = false;
};

// A named part of an element. A field of several numbers ("pos" of 3) is one entry for each ("pos x", "pos y", "pos
// z").
struct NpyField {
  std::string name;
  std::size_t offset = 0;
  // bytes == 0: not a number, such as text.
  NpyNumber number;
};

// What the header of a NumPy file says.
struct NpyHeader {
  // One without a name for a plain array.
  std::vector<NpyField> fields;
  std::size_t item_bytes = 0;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;

  bool is_structured() const { return fields.size() != 1 || !fields[0].name.empty(); }
};

// The dictionary of a header: a Python literal. INVALID_ARGUMENT: it is damaged, or describes what has no numbers, such
// as pickled objects.
absl::StatusOr<NpyHeader> parse_npy_header(absl::string_view dictionary);

// The start of a NumPy file (version 1.0) of float32 [rows, columns], row after row: 128 bytes, whatever the numbers.
std::string npy_header(std::uint64_t rows, std::uint64_t columns);

// The start of a NumPy file (version 1.0) of structures [rows] with a float32 for each name, in their order.
std::string npy_header(std::uint64_t rows, const std::vector<std::string>& names);

}  // namespace isofield
