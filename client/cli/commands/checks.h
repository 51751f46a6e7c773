#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace isofield {

// These checks of options and arguments say in their errors what is expected. CLI11's own checks accept NaN and "5x" as
// numbers, and their messages print the greatest double.

// Accepts finite numbers above 0.
CLI::Validator positive();
// Accepts any finite number.
CLI::Validator number();
// Accepts numbers within [least, most].
CLI::Validator within(double least, double most);
// Accepts whole numbers within [least, most].
CLI::Validator whole(std::uint64_t least, std::uint64_t most);

}  // namespace isofield
