#pragma once

#include "points/npy_header.h"

namespace isofield {

// The number that is stored at `bytes`.
double read_npy_number(const char* bytes, const NpyNumber& number);

}  // namespace isofield
