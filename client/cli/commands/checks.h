#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace isofield {

// What options and arguments are checked with; each says what it expects. CLI11's own checks pass NaN and take "5x" for
// a number, and their messages print the greatest double.

// A finite number above 0.
CLI::Validator positive();
// Any finite number.
CLI::Validator number();
// A number within [least, most].
CLI::Validator within(double least, double most);
// A whole number within [least, most].
CLI::Validator whole(std::uint64_t least, std::uint64_t most);

}  // namespace isofield
