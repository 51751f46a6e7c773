// A composition operator by itself, with its parameters and without operands: what scenes, the catalog of operators,
// reference/ and the device's tapes describe operators with.
#pragma once

#include <algorithm>
#include <compare>
#include <memory>
#include <vector>

#include "operators/opening.h"
#include "operators/sampled_curve.h"
#include "operators/silhouette.h"

namespace isofield::operators {

// What the values of a field mean (scene.proto, FieldLaw).
enum class Law { kPositive, kSigned };

// scene.proto, Form.
enum class Form { kUnion, kIntersection, kDifference };

enum class Kind {
  kSum,
  kMax,
  kMin,
  kDifference,
  kRicci,
  kGradient,
  kClean,
  kBarthe,
  kBernhardt,
  kRUnion,
  kPasko,
  kSuperelliptic,
  kFunctional,
  kBt2,
  kBtk,
  kSampled
};

// What a blend with individual ranges knows of one operand.
struct Term {
  double range = 1;   // r_i
  double power = 2;   // p_i
  double weight = 1;  // m_i
  auto operator<=>(const Term&) const = default;
};

// Values of g on a lattice of (f1, f2, theta): f1 and f2 over [0, 1], theta over [0, pi/4]; f1 fastest.
struct SampledVolume {
  int size = 0;
  std::vector<float> values;  // size^3
};

// The law of the fields that an operator takes and yields. kMax, kMin and kDifference take either.
constexpr bool takes_either_law(Kind kind) {
  return kind == Kind::kMax || kind == Kind::kMin || kind == Kind::kDifference;
}
constexpr Law law_of(Kind kind) {
  switch (kind) {
    case Kind::kRUnion:
    case Kind::kPasko:
    case Kind::kSuperelliptic:
    case Kind::kFunctional:
    case Kind::kBt2:
    case Kind::kBtk:
      return Law::kSigned;
    default:
      return Law::kPositive;
  }
}

// The least c with g <= (1 + c) max(f1, f2) at every sample.
inline double sampled_bound(const SampledVolume& v) {
  double bound = 0;
  for (int i = 0; i < v.size * v.size * v.size; ++i) {
    const int most = std::max(i % v.size, i / v.size % v.size);
    if (most > 0) bound = std::max(bound, double{v.values[i]} * (v.size - 1) / most - 1);
  }
  return bound;
}

// Only what the kind names counts. Angles in radians.
struct Operator {
  Kind kind = Kind::kMax;
  Form form = Form::kUnion;

  double exponent = 1;            // kRicci, kSuperelliptic: t
  Opening opening = camel();      // kGradient, kSampled
  Silhouette silhouette;          // kGradient
  int volume = 0;                 // kGradient: 0, or samples a side
  double theta1 = 0, theta2 = 0;  // kBarthe, kBernhardt
  double weight = 1;              // kBernhardt
  double a0 = 0, a1 = 1, a2 = 1;  // kPasko
  std::vector<Term> terms;        // kSuperelliptic, kBt2, kBtk: one an operand, or one for all
  double conic = 0;               // kBt2: p
  bool by_angle = false;          // kSuperelliptic, kBt2, kBtk: ranges follow the angle between two gradients
  double omega = 0.01;            // by_angle
  SampledCurve curve;             // kFunctional: H, from x >= 0 on
  std::shared_ptr<const SampledVolume> samples;  // kSampled

  const Term& term(std::size_t operand) const { return terms[terms.size() == 1 ? 0 : operand]; }
  // By the angle between two gradients, through an opening function.
  bool is_steered() const { return kind == Kind::kGradient || kind == Kind::kSampled; }
  // Whether the angle between its operands' gradients changes the result.
  bool follows_angle() const { return is_steered() || by_angle; }
  // Of all its operands at once, rather than folded over them.
  bool is_n_ary() const { return kind == Kind::kSuperelliptic || kind == Kind::kBtk; }
  // kBt2: 1 - p / (r1 r2), positive: 1 is the circle or ellipse, and large the union.
  double tightness() const { return 1 - conic / (term(0).range * term(1).range); }
  // The form it is applied in: kDifference is one by itself.
  Form applied_form() const { return kind == Kind::kDifference ? Form::kDifference : form; }
  // Ranges that follow an angle lie between omega and so many times the range that is stated.
  double most_reach() const { return by_angle ? 2 + omega : 1; }
  bool has_volume() const { return kind == Kind::kSampled || (kind == Kind::kGradient && volume != 0); }
};

// What makes two operators' volumes the same.
struct VolumeKey {
  Silhouette silhouette;
  int size = 0;
  const SampledVolume* samples = nullptr;
  auto operator<=>(const VolumeKey&) const = default;
};
inline VolumeKey volume_key(const Operator& op) {
  if (op.kind == Kind::kSampled) return {{}, op.samples->size, op.samples.get()};
  return {op.silhouette, op.volume, nullptr};
}

}  // namespace isofield::operators
