// A composition operator by itself, with its parameters and without operands: what scenes, the catalog of operators,
// reference/ and the device's tapes describe operators with.
#pragma once

#include <array>
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

// Only what the kind names counts. Angles in radians.
struct Operator {
  Kind kind = Kind::kMax;
  Form form = Form::kUnion;

  double exponent = 1;                   // kRicci, kSuperelliptic: t
  Opening opening = camel();             // kGradient, kSampled
  Silhouette silhouette;                 // kGradient
  int volume = 0;                        // kGradient: 0, or samples a side
  double theta1 = 0, theta2 = 0;         // kBarthe, kBernhardt
  double weight = 1;                     // kBernhardt
  double a0 = 0, a1 = 1, a2 = 1;         // kPasko
  std::vector<Term> terms;               // kSuperelliptic, kBt2, kBtk: one an operand, or one for all
  double conic = 0;                      // kBt2: p
  bool by_angle = false;                 // kSuperelliptic, kBt2, kBtk: ranges follow the angle between two gradients
  double omega = 0.01;                   // by_angle
  SampledCurve curve;                    // kFunctional: H
  std::shared_ptr<const SampledVolume> samples;  // kSampled

  const Term& term(std::size_t operand) const { return terms[terms.size() == 1 ? 0 : operand]; }
};

}  // namespace isofield::operators
