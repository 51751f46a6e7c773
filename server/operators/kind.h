// What every kind of operator says of itself. operator.h has the table of all kinds; server/README.md tells how to add
// one. Every function speaks of the union unless it says otherwise, since an intersection and a difference are unions
// of complements.
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

// What the values of a field mean (scene.proto, FieldLaw).
enum class Law { kPositive, kSigned };

// How an operator that is written as a union is applied (scene.proto, Form).
enum class Form { kUnion, kIntersection, kDifference };

// The law of the fields that a kind takes; it yields the same.
enum class Fields { kPositive, kSigned, kEither };

// How a kind takes its operands: two at a time, folded over all of them; so, and steered by the angle between two
// gradients through an opening function; or all at once.
enum class Arity { kFolded, kSteered, kJoint };

struct Traits {
  std::string_view name;  // of the kind's field in the messages Node and Operator, and of its .glsl
  Fields fields;
  Arity arity;
  bool has_form;  // the message states a Form; other kinds are unions
};

struct OperandCount {
  std::size_t least, most;
};
// Operands of one operator that takes them all at once.
inline constexpr std::size_t kMaxOperands = 16;
inline constexpr std::size_t kAnyNumber = ~std::size_t{0};

// What an instruction of a tape does (operator.h).
enum class Opcode : std::uint8_t;

// How a union of signed fields bounds one of its operands: where the result is at most r, this operand is at most
// reach + r times / over. It holds for results below the limit. If times is 0, only results of at most 0 are bounded.
struct Spread {
  double reach = 0;
  double times = 1, over = 1;
  double limit = std::numeric_limits<double>::infinity();
};

// The angle between the gradients of two operands, for kinds whose ranges follow it: its cosine, and the ratio of the
// gradients' lengths, |first| / |second|. Numbers of any type, since both have derivatives.
template <class T>
struct Angle {
  T cosine, ratio;
};

// One use of an operator in a tape: what its record holds beside its own parameters.
struct Use {
  std::uint32_t operands = 2;
  // Steered kinds: the largest range below, against whose inverse gradients are measured to tell whether they vanish.
  double length = 1;
  std::uint32_t volume_slot = 0;  // of an operator that is looked up in a volume
};

// Places of tables that several operators share (tables.h).
class Tables;

// A kind is a struct of its parameters. Beside what stands here it has
//   static K read(message, base::FieldReader& in)
// which reads them from the kind's message; refusals go to `in`.
template <class K>
concept OperatorKind = requires(const K& kind, Law law, std::uint32_t operands, const Use& use, Tables& tables,
                                Float4* out) {
  { K::kTraits } -> std::convertible_to<Traits>;
  { kind.operand_count() } -> std::same_as<OperandCount>;
  // Whether it matters which of two operands is the first of a union.
  { kind.is_ordered() } -> std::same_as<bool>;
  // Whether a surface may turn by 25 degrees and more where two operands meet.
  { kind.may_crease() } -> std::same_as<bool>;
  // What a tape's instruction holds of it, for operands of this law.
  { kind.opcode(law) } -> std::same_as<Opcode>;
  // The vec4s of its record in the device's buffer of operations.
  { kind.record_size(operands) } -> std::same_as<std::uint32_t>;
  // Writes that record, which the kind's .glsl reads.
  { kind.write(use, tables, out) } -> std::same_as<void>;
};

// The families that a kind belongs to by its traits, and what each asks for.
template <class K>
concept IsSigned = K::kTraits.fields == Fields::kSigned;
template <class K>
concept IsFolded = K::kTraits.arity == Arity::kFolded;
template <class K>
concept IsSteered = K::kTraits.arity == Arity::kSteered;
template <class K>
concept IsJoint = K::kTraits.arity == Arity::kJoint;

// unite() is a template over the number, whose result has the partial derivatives (binary.h).
template <class K>
concept FoldedKind = requires(const K& kind, const Interval& a, const Interval& b, double f1, double f2) {
  kind.unite(f1, f2).g1;
  { kind.bound(a, b) } -> std::same_as<Interval>;
};
// blend() is the operator at a given angle theta of the opening. growth() is the least c with
// blend <= max(f1, f2) + c min(f1, f2), which bound() is given.
template <class K, class SilhouetteBounds>
concept SteeredKind = requires(const K& kind, SilhouetteBounds& silhouettes, const Interval& a, double x) {
  kind.opening.theta(x);
  kind.blend(x, x, x).g11;
  { kind.growth(silhouettes) } -> std::same_as<double>;
  { kind.bound(a, a, x) } -> std::same_as<Interval>;
};
// How a result reaches beyond an operand of a union, and beyond the first one of an intersection or a difference.
template <class K>
concept SignedKind = requires(const K& kind, std::size_t operand) {
  { kind.reached(operand) } -> std::same_as<Spread>;
  { kind.kept(operand) } -> std::same_as<Spread>;
};
// The operand, 0 or 1, that alone makes the result, over its weight; or -1 where both may.
template <class K>
concept KnowsALoneOperand = requires(const K& kind, const Interval& a) {
  { kind.lone_operand(a, a) } -> std::same_as<int>;
};
// unite_all() is a template over the number, as unite() is; `mask` names the operands that are left (joint.h).
template <class K, class OperandMask>
concept JointKind = requires(const K& kind, const OperandMask& mask, const std::vector<Interval>& x,
                             const std::vector<double>& fields, const Angle<double>& angle) {
  kind.unite_all(fields, angle).partials;
  { kind.bound_all(mask, x) } -> std::same_as<Interval>;
  // The operands that can make a difference.
  { kind.active(mask, x) } -> std::same_as<std::uint32_t>;
};

}  // namespace isofield::operators
