#include "blobtree/geometry/brick_set.h"

namespace isofield::blobtree {

BrickBox BrickBox::grown(std::uint32_t below, std::uint32_t above) const {
  BrickBox box = *this;
  for (std::uint32_t& i : box.low) i -= std::min(i, below);
  for (std::uint32_t& i : box.high) i += std::min(~i, above);
  return box;
}

bool meet(const BrickBox& a, const BrickBox& b) {
  for (int i = 0; i < 3; ++i) {
    if (a.low[i] >= b.high[i] || b.low[i] >= a.high[i]) return false;
  }
  return true;
}

BrickSet BrickSet::grown(std::uint32_t below, std::uint32_t above) const {
  const BrickBox box = box_.grown(below, above);
  if (members_.empty()) return box;
  BrickSet set(box, [this](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return contains(x, y, z); });
  if (set.members_.empty()) return set;
  // The axes are handled one after the other: along each line, a member is spread to the bricks that it reaches.
  std::size_t stride = 1;
  std::vector<char> line;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t length = box.high[axis] - box.low[axis];
    line.resize(length);
    for (std::size_t first = 0; first < set.members_.size(); ++first) {
      if (first / stride % length != 0) continue;
      std::fill(line.begin(), line.end(), 0);
      for (std::size_t i = 0; i < length; ++i) {
        if (set.members_[first + i * stride] == 0) continue;
        const std::size_t from = i - std::min<std::size_t>(i, below), to = std::min<std::size_t>(i + above + 1, length);
        std::fill(line.begin() + from, line.begin() + to, 1);
      }
      for (std::size_t i = 0; i < length; ++i) set.members_[first + i * stride] = line[i];
    }
    stride *= length;
  }
  return set;
}

BrickSet BrickSet::joined(const BrickSet& other) const {
  BrickBox box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = std::min(box_.low[a], other.box_.low[a]);
    box.high[a] = std::max(box_.high[a], other.box_.high[a]);
  }
  return BrickSet(box, [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return contains(x, y, z) || other.contains(x, y, z);
  });
}

}  // namespace isofield::blobtree
