// These functions are shared by the operators of positive fields that the angle between two gradients steers.
#pragma once

#include <map>

#include "operators/gradient_blend.h"
#include "operators/kind.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// SilhouetteBounds keeps the bounds of the silhouettes seen so far, because each takes a few hundred evaluations.
using SilhouetteBounds = std::map<Silhouette, double>;

// Two operators with equal keys have the same volume. `samples` identifies the volume of an operator that is given by
// samples, `silhouette` and `size` that of others.
struct SampledVolume;
struct VolumeKey {
  Silhouette silhouette;
  int size = 0;  // 0: the operator is looked up in no volume
  const SampledVolume* samples = nullptr;
  auto operator<=>(const VolumeKey&) const = default;
};

// Returns whether the opening comes close to that of the sharp union where gradients differ by 30 to 150 degrees. The
// surface then turns within less than a cell.
bool is_sharp(const Opening& opening);

// Returns the record of a steered operator. `blend` says which silhouette or volume it takes.
Float4 steered_record(const Opening& opening, std::uint32_t blend, const Use& use, Tables& tables);

// Returns the word that the device finds a volume by: the slot of its binding, and its size.
std::uint32_t volume_word(std::uint32_t slot, int size);

// Returns bounds of an operator that is looked up in a volume of `size` nodes a side.
Interval volume_bound(const Interval& a, const Interval& b, int size, double growth);

}  // namespace isofield::operators
