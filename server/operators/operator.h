// This file has the table of all kinds of operators, the table of all opcodes, and Operator, which is a composition
// operator by itself, with its parameters and without operands. Scenes, the catalogue, reference/ and tapes describe
// operators with it.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <type_traits>
#include <variant>

#include "operators/barthe.h"
#include "operators/bernhardt.h"
#include "operators/bt2.h"
#include "operators/btk.h"
#include "operators/clean.h"
#include "operators/difference.h"
#include "operators/functional.h"
#include "operators/gradient.h"
#include "operators/kind.h"
#include "operators/max.h"
#include "operators/min.h"
#include "operators/pasko.h"
#include "operators/r_union.h"
#include "operators/ricci.h"
#include "operators/sampled.h"
#include "operators/smooth_min.h"
#include "operators/sum.h"
#include "operators/superelliptic.h"

namespace isofield::operators {

// ISOFIELD_BLENDS lists every kind of operator that a scene's node may be: its struct, and its field in the messages
// Node and Operator.
#define ISOFIELD_BLENDS(ROW)        \
  ROW(Sum, sum)                     \
  ROW(Max, max)                     \
  ROW(Min, min)                     \
  ROW(Difference, difference)       \
  ROW(Ricci, ricci)                 \
  ROW(Gradient, gradient)           \
  ROW(Clean, clean)                 \
  ROW(Barthe, barthe)               \
  ROW(Bernhardt, bernhardt)         \
  ROW(RUnion, r_union)              \
  ROW(Pasko, pasko)                 \
  ROW(Superelliptic, superelliptic) \
  ROW(Functional, functional)       \
  ROW(Bt2, bt2)                     \
  ROW(Btk, btk)                     \
  ROW(SmoothMin, smooth_min)
// ISOFIELD_OPERATORS adds the kinds that the catalogue alone holds. Scenes use them by name.
#define ISOFIELD_OPERATORS(ROW) \
  ISOFIELD_BLENDS(ROW)          \
  ROW(Sampled, sampled)

// ISOFIELD_OPCODES lists everything that an instruction of a tape may do with its operands: its name, the .glsl in
// shaders/lib/operators/ that holds its function, how that function takes operands (Applies, below), what seams the
// result may have, and whether it takes less time than a leaf.
#define ISOFIELD_OPCODES(ROW)                                                    \
  ROW(Push, push, , kNothing, kNoSeam, kIsLight)                                 \
  ROW(Sum, sum, sum, kTwo, kNoSeam, kIsLight)                                    \
  ROW(Max, max, max, kTwo, kNoSeam, kIsLight)                                    \
  ROW(Min, min, min, kTwo, kNoSeam, kIsLight)                                    \
  ROW(Subtract, subtract, difference, kTwo, kNoSeam, kIsLight)                   \
  ROW(SubtractFrom, subtract_from, difference, kTwo, kNoSeam, kIsLight)          \
  ROW(Ricci, ricci, ricci, kTwo, kNoSeam, kIsHeavy)                              \
  ROW(Gradient, gradient, gradient, kSteeredTwo, kNoSeam, kIsHeavy)              \
  ROW(GradientTable, gradient_table, gradient, kSteeredTwo, kNoSeam, kIsHeavy)   \
  ROW(GradientVolume, gradient_volume, gradient, kSteeredTwo, kNoSeam, kIsHeavy) \
  ROW(Clean, clean, clean, kTwo, kHasSeams, kIsHeavy)                            \
  ROW(Barthe, barthe, barthe, kTwo, kNoSeam, kIsHeavy)                           \
  ROW(Bernhardt, bernhardt, bernhardt, kTwo, kNoSeam, kIsHeavy)                  \
  ROW(Pasko, pasko, pasko, kTwo, kHasSeams, kIsHeavy)                            \
  ROW(Functional, functional, functional, kTwo, kNoSeam, kIsHeavy)               \
  ROW(Bt2, bt2, bt2, kTwo, kHasSeams, kIsHeavy)                                  \
  ROW(SmoothMin, smooth_min, smooth_min, kTwo, kNoSeam, kIsHeavy)                \
  ROW(Superelliptic, superelliptic, superelliptic, kMany, kNoSeam, kIsHeavy)     \
  ROW(Btk, btk, btk, kMany, kNoSeam, kIsHeavy)                                   \
  ROW(Linear, linear, conversions, kOne, kNoSeam, kIsLight)                      \
  ROW(Soften, soften, conversions, kOne, kNoSeam, kIsLight)

#define ISOFIELD_ENUMERATOR(Name, ...) k##Name,
enum class Kind : std::uint8_t { ISOFIELD_OPERATORS(ISOFIELD_ENUMERATOR) kCount };
enum class Opcode : std::uint8_t { ISOFIELD_OPCODES(ISOFIELD_ENUMERATOR) kCount };
#undef ISOFIELD_ENUMERATOR

// Applies says how the function of an opcode takes its operands.
enum class Applies {
  kNothing,     // there is no function: the operand is pushed
  kTwo,         // unite_NAME(a, b, record, angle)
  kSteeredTwo,  // unite_NAME(a, b, u, v, record): u and v have the directions that steer it
  kMany,        // unite_NAME(x, mask, record, angle)
  kOne,         // apply_NAME(a, record); a is the accumulator
};
// A seam is a curve along which the surface turns, where both operands are equal, by less than pictures show as a
// crease. If an opcode is kHasSeams, makes_seams_NAME(record) tells whether its result may have seams. Other functions
// even their own seams out, or have none.
enum class Seams { kNoSeam, kHasSeams };
// kIsLight marks opcodes that take less time than the evaluation of a leaf.
enum class Weight { kIsLight, kIsHeavy };

struct OpcodeTraits {
  std::string_view name, file;
  Applies applies;
  Seams seams;
  Weight weight;
};
#define ISOFIELD_ROW(Name, name, file, applies, seams, weight) \
  OpcodeTraits{#name, #file, Applies::applies, Seams::seams, Weight::weight},
inline constexpr std::array kOpcodes{ISOFIELD_OPCODES(ISOFIELD_ROW)};
#undef ISOFIELD_ROW
static_assert(kOpcodes.size() == static_cast<std::size_t>(Opcode::kCount));

constexpr const OpcodeTraits& traits_of(Opcode op) {
  return kOpcodes[static_cast<std::size_t>(op)];
}

#define ISOFIELD_TYPE(Name, ...) , Name
template <class, class... Kinds>
using VariantOf = std::variant<Kinds...>;
using Parameters = VariantOf<void ISOFIELD_OPERATORS(ISOFIELD_TYPE)>;
#undef ISOFIELD_TYPE
static_assert(std::variant_size_v<Parameters> == static_cast<std::size_t>(Kind::kCount));

#define ISOFIELD_TRAITS(Name, ...) Name::kTraits,
inline constexpr std::array kKinds{ISOFIELD_OPERATORS(ISOFIELD_TRAITS)};
#undef ISOFIELD_TRAITS

// The assertions make the compiler refuse a kind that lacks what its family asks for.
template <class K>
constexpr bool is_complete() {
  static_assert(OperatorKind<K>);
  static_assert(!IsFolded<K> || FoldedKind<K>);
  static_assert(!IsSteered<K> || SteeredKind<K, SilhouetteBounds>);
  static_assert(!IsJoint<K> || JointKind<K, OperandMask>);
  static_assert(!IsSigned<K> || SignedKind<K>);
  static_assert(!(IsSigned<K> && IsFolded<K>) || KnowsALoneOperand<K>);
  return true;
}
#define ISOFIELD_CHECK(Name, ...) static_assert(is_complete<Name>());
ISOFIELD_OPERATORS(ISOFIELD_CHECK)
#undef ISOFIELD_CHECK

// Operator is a composition operator: the parameters of its kind, and its form.
class Operator {
 public:
  Operator() = default;
  // A Difference has the form kDifference, whatever `form` says.
  template <class K>
  requires(!std::is_same_v<std::remove_cvref_t<K>, Operator>)
      Operator(K kind, Form form = Form::kUnion)  // NOLINT: a kind is an operator
      : form(std::is_same_v<K, Difference> ? Form::kDifference : form), parameters(std::move(kind)) {}

  Form form = Form::kUnion;
  Parameters parameters;

  Kind kind() const { return static_cast<Kind>(parameters.index()); }
  const Traits& traits() const { return kKinds[parameters.index()]; }
  // Calls f with the parameters, whose type is the operator's kind.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), parameters);
  }
  // Returns the parameters if the operator is of the kind K, else null.
  template <class K>
  const K* as() const {
    return std::get_if<K>(&parameters);
  }

  // Returns whether the operator takes all its operands at once, rather than being folded over them.
  bool is_joint() const { return traits().arity == Arity::kJoint; }
  // Returns whether the angle between two gradients steers the operator through an opening function.
  bool is_steered() const { return traits().arity == Arity::kSteered; }
  bool takes_either_law() const { return traits().fields == Fields::kEither; }
  // Returns the law of the operator's fields, if its kind takes fields of one law only.
  Law law() const { return traits().fields == Fields::kSigned ? Law::kSigned : Law::kPositive; }
  // Returns whether the operator's ranges follow the angle between two gradients (bulge_elimination.h).
  bool has_angular_ranges() const;
  // Returns whether the angle between its operands' gradients changes the result.
  bool follows_angle() const { return is_steered() || has_angular_ranges(); }
  OperandCount operand_count() const;
  // Returns whether the result depends on which of two operands is the first.
  bool is_ordered() const;
  bool may_crease() const;
  Opcode opcode(Law law) const;
  // Returns what an operand's field is divided by if that operand alone makes the result. It is 1 for all but blends
  // with weights.
  double weight(std::size_t operand) const;
  // Returns the opening of a steered operator, else null.
  const Opening* opening() const;
  // Returns the key of the volume that the operator is looked up in. Its size is 0 if there is none.
  VolumeKey volume_key() const;
};

}  // namespace isofield::operators
