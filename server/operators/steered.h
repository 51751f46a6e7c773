// What operators of positive fields share that are steered by the angle between two gradients.
#pragma once

#include <map>

#include "operators/gradient_blend.h"
#include "operators/kind.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// Bounds of the silhouettes seen so far: each takes a few hundred evaluations.
using SilhouetteBounds = std::map<Silhouette, double>;

// What makes the volumes of two operators the same: `samples` of those that are given by samples, else the others.
struct SampledVolume;
struct VolumeKey {
  Silhouette silhouette;
  int size = 0;  // 0: the operator is looked up in no volume
  const SampledVolume* samples = nullptr;
  auto operator<=>(const VolumeKey&) const = default;
};

// Whether the opening comes close to that of the sharp union where gradients differ by 30 to 150 degrees: there the
// surface turns within less than a cell.
bool is_sharp(const Opening& opening);

// The record of a steered operator; `blend` says which silhouette or volume it takes.
Float4 steered_record(const Opening& opening, std::uint32_t blend, const Use& use, Tables& tables);

// What the device finds a volume by: the slot of its binding, and its size.
std::uint32_t volume_word(std::uint32_t slot, int size);

// The interval of an operator that is looked up in a volume of `size` nodes a side.
Interval volume_bound(const Interval& a, const Interval& b, int size, double growth);

}  // namespace isofield::operators
