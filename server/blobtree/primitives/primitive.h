// This file has the table of all kinds of primitives, the table of all leaves that instructions may have, and
// Primitive, which is a primitive by itself.
#pragma once

#include <absl/status/status.h>

#include <array>
#include <utility>
#include <variant>

#include "blobtree/primitives/box.h"
#include "blobtree/primitives/cone.h"
#include "blobtree/primitives/cylinder.h"
#include "blobtree/primitives/ellipsoid.h"
#include "blobtree/primitives/half_space.h"
#include "blobtree/primitives/kind.h"
#include "blobtree/primitives/segment.h"
#include "blobtree/primitives/sphere.h"
#include "blobtree/primitives/torus.h"
#include "operators/kind.h"

namespace isofield::v1 {
class Node;
}

namespace isofield::blobtree {

// ISOFIELD_PRIMITIVES lists every kind: its struct, and its field in the message Node.
#define ISOFIELD_PRIMITIVES(ROW) \
  ROW(Sphere, sphere)            \
  ROW(Segment, segment)          \
  ROW(Box, box)                  \
  ROW(Cylinder, cylinder)        \
  ROW(Torus, torus)              \
  ROW(Ellipsoid, ellipsoid)      \
  ROW(HalfSpace, half_space)     \
  ROW(Cone, cone)

// ISOFIELD_LEAVES lists every right operand of an instruction that is a leaf: its name, the .glsl in
// shaders/lib/primitives/ that holds its function NAME_field(p, record), and the vec4s of its record.
#define ISOFIELD_LEAVES(ROW)                     \
  ROW(Sphere, sphere, sphere, 2)                 \
  ROW(Segment, segment, segment, 3)              \
  ROW(Box, box, box, 5)                          \
  ROW(Cylinder, cylinder, cylinder, 4)           \
  ROW(Torus, torus, torus, 4)                    \
  ROW(Ellipsoid, ellipsoid, sphere, 4)           \
  ROW(AffineSegment, affine_segment, segment, 4) \
  ROW(HalfSpace, half_space, half_space, 2)      \
  ROW(Cone, cone, cone, 5)

#define ISOFIELD_ENUMERATOR(Name, ...) k##Name,
enum class Operand : std::uint8_t {
  kPop,   // the accumulator; the left operand is then popped off the stack
  kZero,  // the constant 0: the right operand was culled, or there is none
  ISOFIELD_LEAVES(ISOFIELD_ENUMERATOR) kCount
};
#undef ISOFIELD_ENUMERATOR
inline constexpr std::size_t kFirstLeaf = 2;
constexpr bool is_leaf(Operand operand) {
  return static_cast<std::size_t>(operand) >= kFirstLeaf;
}

struct OperandTraits {
  std::string_view name, file;
  std::uint32_t record_size;
};
#define ISOFIELD_ROW(Name, name, file, record_size) OperandTraits{#name, #file, record_size},
inline constexpr std::array kOperands{OperandTraits{"pop", "", 0}, OperandTraits{"zero", "", 0},
                                      ISOFIELD_LEAVES(ISOFIELD_ROW)};
#undef ISOFIELD_ROW
static_assert(kOperands.size() == static_cast<std::size_t>(Operand::kCount));

// Returns how many vec4s the operand's record takes in the buffer of leaves.
constexpr std::uint32_t record_size(Operand operand) {
  return kOperands[static_cast<std::size_t>(operand)].record_size;
}

#define ISOFIELD_TYPE(Name, ...) , shapes::Name
template <class, class... Kinds>
using VariantOf = std::variant<Kinds...>;
using Shape = VariantOf<void ISOFIELD_PRIMITIVES(ISOFIELD_TYPE)>;
#undef ISOFIELD_TYPE

#define ISOFIELD_CHECK(Name, ...) static_assert(PrimitiveKind<shapes::Name>);
ISOFIELD_PRIMITIVES(ISOFIELD_CHECK)
#undef ISOFIELD_CHECK

#define ISOFIELD_TRAITS(Name, ...) shapes::Name::kTraits,
inline constexpr std::array kShapes{ISOFIELD_PRIMITIVES(ISOFIELD_TRAITS)};
#undef ISOFIELD_TRAITS

// A Primitive is a shape with the law of its field, in the frame of its node.
struct Primitive {
  Shape shape;
  operators::Law law = operators::Law::kPositive;
  double range = 0;  // only for positive fields
  Affine frame;      // maps the shape's own frame to the node's
};

// Reads the primitive of a node, which must be of one of the kinds above.
Primitive read_primitive(const v1::Node& node, FieldReader& in);

inline const PrimitiveTraits& traits_of(const Shape& shape) {
  return kShapes[shape.index()];
}

}  // namespace isofield::blobtree
