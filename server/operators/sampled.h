// Sampled is an operator of positive fields that is given by samples of g(f1, f2, theta), and steered as the
// gradient-based blend is.
#pragma once

#include <memory>
#include <vector>

#include "operators/kind.h"
#include "operators/steered.h"

namespace isofield::v1 {
class SampledOperator;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

// SampledVolume has the values of g on a lattice of (f1, f2, theta): f1 and f2 over [0, 1], theta over [0, pi/4]. f1
// varies fastest.
struct SampledVolume {
  int size = 0;
  std::vector<float> values;  // size^3
};

struct Sampled {
  static constexpr Traits kTraits{"sampled", Fields::kPositive, Arity::kSteered, true};
  static Sampled read(const v1::SampledOperator& message, base::FieldReader& in);

  Opening opening = camel();
  std::shared_ptr<const SampledVolume> samples;

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  VolumeKey volume_key() const { return {{}, samples->size, samples.get()}; }
  Blend blend(double f1, double f2, double theta) const;
  // Returns the least c with g <= (1 + c) max(f1, f2) at every sample.
  double growth(SilhouetteBounds& silhouettes) const;
  Interval bound(const Interval& a, const Interval& b, double growth) const;
};

}  // namespace isofield::operators
