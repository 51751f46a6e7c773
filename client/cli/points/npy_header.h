#pragma once

#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isofield {

// Says how a number is stored in a NumPy array.
struct NpyNumber {
  char kind = 'f';  // 'f': IEEE float, 'i': signed, 'u': unsigned
  std::size_t bytes = 4;
  bool big_endian = false;
};

// A named part of an array's element. A field of several numbers has an entry for each of them: "pos" of 3 numbers
// becomes "pos x", "pos y" and "pos z".
struct NpyField {
  std::string name;
  std::size_t offset = 0;
  // Its `bytes` are 0 if the field is not a number but, for example, text.
  NpyNumber number;
};

// The contents of a NumPy file's header.
struct NpyHeader {
  // A plain array has one field without a name.
  std::vector<NpyField> fields;
  std::size_t item_bytes = 0;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;

  bool is_structured() const { return fields.size() != 1 || !fields[0].name.empty(); }
};

// Parses the dictionary of a header, which is a Python literal. INVALID_ARGUMENT: it is damaged, or the array has no
// numbers but, for example, pickled objects.
absl::StatusOr<NpyHeader> parse_npy_header(absl::string_view dictionary);

// Returns the start of a NumPy file (version 1.0) with an array of float32 [rows, columns], row after row. It always
// has 128 bytes, so that it can be overwritten once the number of rows is known.
std::string npy_header(std::uint64_t rows, std::uint64_t columns);

// Returns the start of a NumPy file (version 1.0) with an array of structures [rows] that have a float32 for each name,
// in the order of the names.
std::string npy_header(std::uint64_t rows, const std::vector<std::string>& names);

}  // namespace isofield
