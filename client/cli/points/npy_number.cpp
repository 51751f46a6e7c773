#include "points/npy_number.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace isofield {
namespace {

template <class T>
double as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

// Reads a float16 (IEEE 754 binary16).
double read_half(const char* bytes) {
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  double value = std::ldexp(exponent == 0 ? fraction : fraction + 1024, std::max(exponent, 1) - 25);
  if (exponent == 31) value = fraction == 0 ? HUGE_VAL : std::numeric_limits<double>::quiet_NaN();
  return bits >> 15 ? -value : value;
}

}  // namespace

double read_npy_number(const char* bytes, const NpyNumber& number) {
  char little[8];
  if (number.big_endian) {
    std::reverse_copy(bytes, bytes + number.bytes, little);
    bytes = little;
  }
  switch (number.kind) {
    case 'i':
      return number.bytes == 1   ? as<std::int8_t>(bytes)
             : number.bytes == 2 ? as<std::int16_t>(bytes)
             : number.bytes == 4 ? as<std::int32_t>(bytes)
                                 : as<std::int64_t>(bytes);
    case 'u':
      return number.bytes == 1   ? as<std::uint8_t>(bytes)
             : number.bytes == 2 ? as<std::uint16_t>(bytes)
             : number.bytes == 4 ? as<std::uint32_t>(bytes)
                                 : as<std::uint64_t>(bytes);
    default:
      return number.bytes == 2 ? read_half(bytes) : number.bytes == 4 ? as<float>(bytes) : as<double>(bytes);
  }
}

}  // namespace isofield
