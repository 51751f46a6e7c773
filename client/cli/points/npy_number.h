#pragma once

#include "points/npy_header.h"

namespace isofield {

// Reads the number at `bytes`, which need not be aligned.
double read_npy_number(const char* bytes, const NpyNumber& number);

}  // namespace isofield
