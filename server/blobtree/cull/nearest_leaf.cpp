#include "blobtree/cull/nearest_leaf.h"

#include <cmath>
#include <limits>

#include "blobtree/cull/point_bins.h"

namespace isofield::blobtree {
namespace {

std::uint32_t nearest(const Tape& tape, std::span<const Instruction> code, const dvec3& p) {
  std::uint32_t found = kNoLeaf;
  double least = std::numeric_limits<double>::infinity();
  for (const Instruction& i : code) {
    if (!i.is_leaf()) continue;
    const Leaf& leaf = tape.leaves[i.index];
    const double d = leaf.distance(p);
    if (leaf.law == operators::Law::kPositive && d >= leaf.range) continue;
    const double far = std::abs(d) / leaf.domain.stretch;
    if (far < least) {
      least = far;
      found = i.index;
    }
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> nearest_leaves(const Tape& tape, std::span<const float> xyz) {
  std::vector<std::uint32_t> leaves(xyz.size() / 3, kNoLeaf);
  const PointBins bins = bin_points(tape, xyz);
  for (const PointGroup& g : bins.groups) {
    if (g.tape_count == 0) continue;
    const std::span<const Instruction> code(bins.code.data() + g.tape_begin, g.tape_count);
    for (std::uint32_t n = g.first; n < g.first + g.count; ++n) {
      const std::size_t place = bins.points ? bins.points[n].place : n;
      leaves[place] = nearest(tape, code, {xyz[3 * place], xyz[3 * place + 1], xyz[3 * place + 2]});
    }
  }
  return leaves;
}

}  // namespace isofield::blobtree
