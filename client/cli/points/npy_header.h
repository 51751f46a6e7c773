#pragma once

#include <cstdint>
#include <string>

namespace isofield {

// The start of a NumPy file (version 1.0) of float32 [rows, columns], row after row: 128 bytes, whatever the numbers.
std::string npy_header(std::uint64_t rows, std::uint64_t columns);

}  // namespace isofield
