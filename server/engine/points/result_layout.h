// Names the quantities that can be asked of the field at a point, and says how the answer lies in memory. To add a
// quantity, add it here, to v1::Quantity, and to the kernels that write it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

namespace isofield::engine {

enum class Quantity : std::uint8_t { kValue, kGradient };

struct QuantityTraits {
  Quantity quantity;
  std::size_t numbers;               // how many a point has
  std::array<const char*, 3> names;  // the names of these numbers
};
// The quantities in the order in which the numbers of a point lie.
inline constexpr std::array kQuantities{QuantityTraits{Quantity::kValue, 1, {"value"}},
                                        QuantityTraits{Quantity::kGradient, 3, {"gx", "gy", "gz"}}};

// A set of quantities. An answer holds a row of float32 numbers for each point, one row after the other.
class ResultLayout {
 public:
  static const ResultLayout kValue, kValueAndGradient;

  constexpr ResultLayout(std::initializer_list<Quantity> quantities) {
    for (const Quantity q : quantities) bits_ |= bit(q);
  }

  constexpr bool has(Quantity q) const { return (bits_ & bit(q)) != 0; }
  // Return how many numbers one point has, and how many `points` have.
  constexpr std::size_t numbers() const { return first_after(kQuantities.size()); }
  constexpr std::size_t numbers(std::size_t points) const { return numbers() * points; }
  constexpr std::size_t bytes() const { return numbers() * sizeof(float); }
  // Returns the place in a row at which the quantity begins.
  constexpr std::size_t first(Quantity q) const { return first_after(static_cast<std::size_t>(q)); }
  // Returns the names of a row's numbers, such as "value, gx, gy, gz".
  std::string names() const {
    std::string all;
    for (const QuantityTraits& t : kQuantities) {
      for (std::size_t n = 0; has(t.quantity) && n < t.numbers; ++n) {
        all.append(all.empty() ? "" : ", ").append(t.names[n]);
      }
    }
    return all;
  }

  constexpr bool operator==(const ResultLayout&) const = default;

 private:
  static constexpr std::uint8_t bit(Quantity q) { return static_cast<std::uint8_t>(1u << static_cast<unsigned>(q)); }
  // Counts the numbers of this layout's quantities among the first `count` of the table.
  constexpr std::size_t first_after(std::size_t count) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += has(kQuantities[i].quantity) ? kQuantities[i].numbers : 0;
    return sum;
  }

  std::uint8_t bits_ = 0;
};

inline constexpr ResultLayout ResultLayout::kValue{Quantity::kValue};
inline constexpr ResultLayout ResultLayout::kValueAndGradient{Quantity::kValue, Quantity::kGradient};

// A view of the answer for a batch of points, by point and quantity.
class ResultRows {
 public:
  // `numbers` holds whole rows and must outlive this.
  ResultRows(ResultLayout layout, std::span<const float> numbers) : layout_(layout), numbers_(numbers) {}

  std::size_t size() const { return numbers_.size() / layout_.numbers(); }
  // Return a quantity of point n. The layout must have the quantity.
  float value(std::size_t n) const { return at(n, Quantity::kValue)[0]; }
  std::array<float, 3> gradient(std::size_t n) const {
    const float* const g = at(n, Quantity::kGradient);
    return {g[0], g[1], g[2]};
  }

 private:
  const float* at(std::size_t n, Quantity q) const { return &numbers_[layout_.numbers(n) + layout_.first(q)]; }

  ResultLayout layout_;
  std::span<const float> numbers_;
};

}  // namespace isofield::engine
