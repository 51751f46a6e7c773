#pragma once

#include <cstdint>

#include "commands/command_line.h"

namespace isofield {

// These checks of options and arguments say in their errors what is expected. CLI11's own checks accept NaN and "5x" as
// numbers, and their messages print the greatest double.

// Accepts finite numbers above 0.
Check positive();
// Accepts any finite number.
Check number();
// Accepts numbers within [least, most].
Check within(double least, double most);
// Accepts whole numbers within [least, most].
Check whole(std::uint64_t least, std::uint64_t most);

}  // namespace isofield
