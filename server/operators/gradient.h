// Gradient is the gradient-based blend of positive fields, [G] sections 3 to 5: the angle between two gradients steers
// how much is blended.
#pragma once

#include "operators/kind.h"
#include "operators/steered.h"

namespace isofield::v1 {
class GradientBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Gradient {
  static constexpr Traits kTraits{"gradient", Fields::kPositive, Arity::kSteered, true};
  static Gradient read(const v1::GradientBlend& message, base::FieldReader& in);

  Opening opening = camel();
  Silhouette silhouette;
  int volume = 0;  // samples a side of the volume that it is looked up in, or 0 for none

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return !silhouette.is_symmetric(); }
  bool may_crease() const;
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  VolumeKey volume_key() const { return volume == 0 ? VolumeKey{} : VolumeKey{silhouette, volume, nullptr}; }
  // Returns the exact blend, or the one that the volume gives if the operator is looked up in one.
  Blend blend(double f1, double f2, double theta) const;
  double growth(SilhouetteBounds& silhouettes) const;
  Interval bound(const Interval& a, const Interval& b, double growth) const;
};

}  // namespace isofield::operators
