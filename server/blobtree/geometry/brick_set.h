// BrickSet is a set of bricks of a lattice: all bricks of a box, or some of them. BrickBox is a box of bricks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace isofield::blobtree {

// The box holds the bricks from `low` on and below `high`, along x, y and z.
struct BrickBox {
  std::array<std::uint32_t, 3> low{}, high{};

  bool contains(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x >= low[0] && x < high[0] && y >= low[1] && y < high[1] && z >= low[2] && z < high[2];
  }
  bool is_empty() const { return low[0] >= high[0] || low[1] >= high[1] || low[2] >= high[2]; }
  BrickBox grown(std::uint32_t below, std::uint32_t above) const;

  bool operator==(const BrickBox&) const = default;
};

bool meet(const BrickBox& a, const BrickBox& b);

class BrickSet {
 public:
  // Makes a set of all bricks of the box.
  BrickSet(const BrickBox& box) : box_(box) {}
  // Makes a set of the bricks of the box for which is_member(x, y, z) is true. A box of more than kMostToldApart bricks
  // is taken whole, because every use of a set stays right when the set has more bricks.
  template <class Member>
  BrickSet(const BrickBox& box, const Member& is_member) : box_(box) {
    if (box.is_empty() || volume() > kMostToldApart) return;
    members_.resize(static_cast<std::size_t>(volume()));
    char* member = members_.data();
    for (std::uint32_t z = box.low[2]; z < box.high[2]; ++z) {
      for (std::uint32_t y = box.low[1]; y < box.high[1]; ++y) {
        for (std::uint32_t x = box.low[0]; x < box.high[0]; ++x) *member++ = is_member(x, y, z) ? 1 : 0;
      }
    }
  }

  const BrickBox& box() const { return box_; }
  bool contains(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return box_.contains(x, y, z) && (members_.empty() || members_[place(x, y, z)] != 0);
  }
  // Returns this set together with the bricks up to `below` before and up to `above` after each member along every
  // axis, diagonal neighbours included.
  BrickSet grown(std::uint32_t below, std::uint32_t above) const;
  BrickSet joined(const BrickSet& other) const;

  bool operator==(const BrickSet&) const = default;

 private:
  static constexpr double kMostToldApart = 1u << 22;

  double volume() const {
    return static_cast<double>(box_.high[0] - box_.low[0]) * (box_.high[1] - box_.low[1]) *
           (box_.high[2] - box_.low[2]);
  }
  std::size_t place(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x - box_.low[0] +
           std::size_t{box_.high[0] - box_.low[0]} *
               (y - box_.low[1] + std::size_t{box_.high[1] - box_.low[1]} * (z - box_.low[2]));
  }

  BrickBox box_;
  std::vector<char> members_;  // by place(); empty if all bricks of the box are members
};

}  // namespace isofield::blobtree
