// What every kind of operator says of itself. operator.h has the table of all kinds; server/README.md tells how to add one.
//
// A kind is a struct of its parameters with these members, beside what its family asks for (below):
//   kTraits                          what holds of every operator of the kind
//   read(message, in)                reads the parameters from the kind's message; refusals go to `in`
//   operand_count()                  how many operands it takes
//   is_ordered()                     whether it matters which of two operands is the first of a union
//   may_crease()                     whether a surface may turn by 25 degrees and more where two operands meet
//   opcode(law)                      what a tape's instruction holds of it, for operands of this law
//   record_size(operands)            vec4s of its record in the device's buffer of operations
//   write(use, tables, out)          writes that record, which the kind's .glsl reads
// Fields are in units of their own; every function speaks of the union unless it says otherwise, since an intersection and
// a difference are unions of complements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

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

// How a kind takes its operands. What it needs beside the members above depends on this:
//   kFolded   two at a time, folded over the operands:  unite(f1, f2), a template over the number that returns a Binary;
//             bound(a, b), the interval of the union of two intervals
//   kSteered  folded, and steered by the angle between two gradients through an opening function:  opening;
//             blend(f1, f2, theta); growth(silhouettes), the least c with blend <= max(f1, f2) + c min(f1, f2);
//             bound(a, b, growth)
//   kJoint    all at once:  unite_all(fields, angle), a template that returns a Joint; bound_all(mask, intervals);
//             active(mask, intervals), the operands that can make a difference
// Kinds of signed fields have reached(operand) and kept(operand), too, and folded ones of them lone_operand(a, b).
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

// Of a union of signed fields: where the result is at most r, this operand is at most `reach` + r `times` / `over`, for
// results below `limit`. With times = 0 the operand's own field says nothing of how the result grows.
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

}  // namespace isofield::operators
