#include "engine/mesh/mesh_samples.h"

#include "engine/mesh/mesh_layout.h"

namespace isofield::engine {
namespace {

// The places of the bricks above in brick_neighbours().
constexpr std::size_t kX = kNeighboursAbove[0], kY = kNeighboursAbove[1], kZ = kNeighboursAbove[2],
                      kYZ = kNeighboursAbove[3], kXZ = kNeighboursAbove[4], kXY = kNeighboursAbove[5];

}  // namespace

SlabOctets slab_octets(std::span<const std::uint32_t> neighbours, std::uint32_t first, std::uint32_t count) {
  const auto at = [&](std::uint32_t brick, std::size_t neighbour) {
    return neighbours[kNeighbours * brick + neighbour];
  };
  SlabOctets octets;
  octets.evaluated.assign(count, 0xffff);
  octets.taken_over.reserve(std::size_t{kOctets - kOwnOctets} * count);
  for (std::uint32_t b = first; b < first + count; ++b) {
    const auto take_over = [&](std::uint32_t octet, std::uint32_t from, std::uint32_t last_from) {
      const auto is_here = [&](std::uint32_t brick) {
        return brick != kNoBrick && brick >= first && brick < first + count;
      };
      if (!is_here(from) || !is_here(last_from)) return;
      octets.evaluated[b - first] &= static_cast<std::uint16_t>(~(1u << octet));
      octets.taken_over.push_back({b - first, octet, from - first, last_from - first});
    };
    std::uint32_t octet = kOwnOctets;
    for (const std::size_t face : {kX, kY, kZ}) {
      for (int half = 0; half < 2; ++half) take_over(octet++, at(b, face), at(b, face));
    }
    const std::uint32_t beside = at(b, kXY);
    take_over(octet++, beside, at(b, kXZ));
    take_over(octet++, at(b, kYZ), beside == kNoBrick ? kNoBrick : at(beside, kZ));
  }
  return octets;
}

}  // namespace isofield::engine
