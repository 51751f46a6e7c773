#include "engine/mesh/mesh_samples.h"

#include "engine/mesh/mesh_lattice.h"

namespace isofield::engine {
namespace {

// Places in brick_neighbours() of the bricks above.
constexpr std::size_t kX = kNeighboursAbove[0], kY = kNeighboursAbove[1], kZ = kNeighboursAbove[2],
                      kYZ = kNeighboursAbove[3], kXZ = kNeighboursAbove[4], kXY = kNeighboursAbove[5];
constexpr std::uint32_t kNone = ~0u;

}  // namespace

SampleParts sample_parts(std::span<const std::uint32_t> neighbours, std::uint32_t first, std::uint32_t count) {
  const auto at = [&](std::uint32_t brick, std::size_t neighbour) {
    return neighbours[kNeighbours * brick + neighbour];
  };
  SampleParts parts;
  parts.evaluated.assign(count, 0xffff);
  parts.taken_over.reserve(std::size_t{kSampleParts - kOwnSampleParts} * count);
  for (std::uint32_t b = first; b < first + count; ++b) {
    const auto take_over = [&](std::uint32_t part, std::uint32_t from, std::uint32_t last_from) {
      const auto is_here = [&](std::uint32_t brick) {
        return brick != kNone && brick >= first && brick < first + count;
      };
      if (!is_here(from) || !is_here(last_from)) return;
      parts.evaluated[b - first] &= static_cast<std::uint16_t>(~(1u << part));
      parts.taken_over.push_back({b - first, part, from - first, last_from - first});
    };
    std::uint32_t part = kOwnSampleParts;
    for (const std::size_t face : {kX, kY, kZ}) {
      for (int half = 0; half < 2; ++half) take_over(part++, at(b, face), at(b, face));
    }
    const std::uint32_t beside = at(b, kXY);
    take_over(part++, beside, at(b, kXZ));
    take_over(part++, at(b, kYZ), beside == kNone ? kNone : at(beside, kZ));
  }
  return parts;
}

}  // namespace isofield::engine
