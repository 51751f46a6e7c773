// DisjointSets joins numbered things to sets, and tells which of them are in one set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace isofield::engine {

// A forest whose paths are halved as they are walked (Tarjan and van Leeuwen 1984). Not thread-safe, not even root().
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  std::uint32_t size() const { return static_cast<std::uint32_t>(parents_.size()); }
  // Returns the lowest number in the set of i.
  std::uint32_t root(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    if (parents_[a] == parents_[b]) return;
    a = root(a), b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace isofield::engine
