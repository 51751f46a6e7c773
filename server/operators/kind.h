// The concept OperatorKind and those after it list what every kind of operator provides. operator.h has the table of
// all kinds; server/README.md tells how to add one. Every function speaks of the union unless it says otherwise, since
// an intersection and a difference are unions of complements. In this folder [G] is Gourmel et al. 2013, and [H] is Hsu
// 2006.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "base/float4.h"
#include "base/interval.h"

namespace isofield::operators {

using base::f32;
using base::Float4;
using base::Interval;

// Law is what the values of a field mean (scene.proto, FieldLaw): positive fields are 0.5 on the surface and fall off
// to 0 outside, and signed fields are a kind of distance, negative inside.
enum class Law { kPositive, kSigned };

// Form is how an operator that is written as a union is applied (scene.proto, Form).
enum class Form { kUnion, kIntersection, kDifference };

// Fields is the law of the fields that a kind takes; its result has the same law.
enum class Fields { kPositive, kSigned, kEither };

// Arity is how a kind takes its operands. A folded kind takes two at a time. A steered kind does so, too, and the angle
// between their gradients steers it through an opening function. A joint kind takes all at once.
enum class Arity { kFolded, kSteered, kJoint };

struct Traits {
  std::string_view name;  // names the kind's field in the messages Node and Operator, and its .glsl
  Fields fields;
  Arity arity;
  bool has_form;  // the message states a Form; other kinds are unions
};

struct OperandCount {
  std::size_t least, most;
};
// An operator that takes all its operands at once has at most this many.
inline constexpr std::size_t kMaxOperands = 16;
inline constexpr std::size_t kAnyNumber = ~std::size_t{0};

// Opcode is what an instruction of a tape does (operator.h).
enum class Opcode : std::uint8_t;

// Spread tells how the result of an operator of signed fields bounds one of its operands: if the result is at most r,
// this operand is at most reach + r times / over. This holds for results below the limit.
struct Spread {
  double reach = 0;
  double times = 1, over = 1;
  double limit = std::numeric_limits<double>::infinity();
};

// Angle describes the angle between the gradients of two operands, for kinds whose ranges follow it: its cosine, and
// the ratio of the gradients' lengths, |first| / |second|. Both are numbers of the type T, because both have
// derivatives.
template <class T>
struct Angle {
  T cosine, ratio;
};

// Use is one use of an operator in a tape: what its record holds besides the operator's own parameters.
struct Use {
  std::uint32_t operands = 2;
  // For steered kinds this is the largest range below. Gradients are compared with its inverse to tell whether they
  // vanish.
  double length = 1;
  std::uint32_t volume_slot = 0;  // only for an operator that is looked up in a volume
};

// Tables holds the tables that several operators share (tables.h).
class Tables;

// A kind is a struct of its parameters. Besides the functions below it has
//   static K read(message, base::FieldReader& in)
// This function reads the parameters from the kind's message, and reports refusals to `in`.
template <class K>
concept OperatorKind = requires(const K& kind, Law law, std::uint32_t operands, const Use& use, Tables& tables,
                                Float4* out) {
  { K::kTraits } -> std::convertible_to<Traits>;
  { kind.operand_count() } -> std::same_as<OperandCount>;
  // Returns whether it matters which of two operands is the first of a union.
  { kind.is_ordered() } -> std::same_as<bool>;
  // Returns whether a surface may turn by 25 degrees or more where two operands meet.
  { kind.may_crease() } -> std::same_as<bool>;
  // Returns the opcode that an instruction has for the kind and for operands of this law.
  { kind.opcode(law) } -> std::same_as<Opcode>;
  // Returns how many vec4s its record takes in the device's buffer of operations.
  { kind.record_size(operands) } -> std::same_as<std::uint32_t>;
  // Writes that record, which holds the numbers that the kind's .glsl reads.
  { kind.write(use, tables, out) } -> std::same_as<void>;
};

// IsSigned, IsFolded, IsSteered and IsJoint are the families that a kind belongs to by its traits. The concepts after
// them are what each family asks for.
template <class K>
concept IsSigned = K::kTraits.fields == Fields::kSigned;
template <class K>
concept IsFolded = K::kTraits.arity == Arity::kFolded;
template <class K>
concept IsSteered = K::kTraits.arity == Arity::kSteered;
template <class K>
concept IsJoint = K::kTraits.arity == Arity::kJoint;

// unite() is a template over the number type and returns the value with its partial derivatives (binary.h). bound()
// returns bounds of the result from intervals of the operands.
template <class K>
concept FoldedKind = requires(const K& kind, const Interval& a, const Interval& b, double f1, double f2) {
  kind.unite(f1, f2).g1;
  { kind.bound(a, b) } -> std::same_as<Interval>;
};
// blend() is the operator at a given angle theta of the opening. growth() returns the least c with
//   blend <= max(f1, f2) + c min(f1, f2)
// unless the kind says otherwise (sampled.h), and bound() takes this c.
template <class K, class SilhouetteBounds>
concept SteeredKind = requires(const K& kind, SilhouetteBounds& silhouettes, const Interval& a, double x) {
  kind.opening.theta(x);
  kind.blend(x, x, x).g11;
  { kind.growth(silhouettes) } -> std::same_as<double>;
  { kind.bound(a, a, x) } -> std::same_as<Interval>;
};
// reached() bounds an operand of a union by the result. kept() does the same for an operand of an intersection, and for
// the first operand of a difference.
template <class K>
concept SignedKind = requires(const K& kind, std::size_t operand) {
  { kind.reached(operand) } -> std::same_as<Spread>;
  { kind.kept(operand) } -> std::same_as<Spread>;
};
// lone_operand() returns the operand, 0 or 1, that alone makes the result, which is then that operand over its weight,
// or -1 if both may.
template <class K>
concept KnowsALoneOperand = requires(const K& kind, const Interval& a) {
  { kind.lone_operand(a, a) } -> std::same_as<int>;
};
// unite_all() is a template over the number type, as unite() is. `mask` names the operands that are left (joint.h).
template <class K, class OperandMask>
concept JointKind = requires(const K& kind, const OperandMask& mask, const std::vector<Interval>& x,
                             const std::vector<double>& fields, const Angle<double>& angle) {
  kind.unite_all(fields, angle).partials;
  { kind.bound_all(mask, x) } -> std::same_as<Interval>;
  // Returns the operands that can make a difference.
  { kind.active(mask, x) } -> std::same_as<std::uint32_t>;
};

}  // namespace isofield::operators
