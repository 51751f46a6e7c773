// A scene compiled for evaluation: a flat program in postfix order whose instructions each fuse a leaf with the
// operator that takes it (engine notes: an indexed stack and unfused leaves are many times slower).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "blobtree/affine.h"
#include "blobtree/distance.h"
#include "operators/opening.h"
#include "operators/silhouette.h"

namespace isofield::blobtree {

// What an instruction takes as its right operand. Mirrored in shaders/lib/opcodes.glsl.
enum class Operand : std::uint32_t {
  kPop = 0,     // the accumulator; what is popped off the stack takes its place as the left operand
  kZero = 1,    // the constant 0: a right operand that was culled
  kSphere = 2,  // leaves; rigidly placed unless said otherwise
  kSegment = 3,
  kBox = 4,  // any affine placement, as all below
  kCylinder = 5,
  kTorus = 6,
  kEllipsoid = 7,  // a sphere under an affine map
  kAffineSegment = 8,
};
// What it does with it. `acc` is the accumulator. Mirrored in shaders/lib/opcodes.glsl.
enum class Operator : std::uint32_t {
  kPush = 0,  // push acc, acc = operand
  kSum = 1,   // acc = acc + operand
  kMax = 2,
  kMin = 3,
  kSubtract = 4,      // acc = max(0, min(acc, 1 - operand))
  kSubtractFrom = 5,  // acc = max(0, min(operand, 1 - acc))
  kRicci = 6,
  kGradient = 7,       // smooth silhouette: its profile is a polynomial
  kGradientTable = 8,  // any other: from a table
};

// As the device reads it: 16 bytes.
struct Instruction {
  std::uint32_t code;       // operand | operator << 8
  std::uint32_t leaf;       // place of the leaf's record in the leaf buffer, in vec4
  std::uint32_t operation;  // place of the operator's record in the operator buffer, in vec4
  std::uint32_t index;      // host only: the leaf in Tape::leaves (leaf operands)

  Operand operand() const { return static_cast<Operand>(code & 0xff); }
  Operator op() const { return static_cast<Operator>(code >> 8); }
  bool is_leaf() const { return operand() >= Operand::kSphere; }
};
inline Instruction instruction(Operand operand, Operator op, std::uint32_t leaf = 0, std::uint32_t operation = 0,
                               std::uint32_t index = 0) {
  return {static_cast<std::uint32_t>(operand) | static_cast<std::uint32_t>(op) << 8, leaf, operation, index};
}

struct Box {
  dvec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  dvec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Box& other);
  bool touches(const Box& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y &&
           min.z <= other.max.z && other.min.z <= max.z;
  }
};

// A placed primitive. A world point p is q = to_local (p - anchor) in the shape's own frame.
struct Leaf {
  Operand operand = Operand::kSphere;
  Shape shape = Shape::kSphere;
  ShapeSize size{};
  double range = 0;
  Affine to_local;  // linear part only
  dvec3 anchor;
  double stretch = 1;        // most that to_local stretches: bounds the slope of the distance
  Box support;               // holds every point where the field is not 0, with room for float32 rounding
  std::uint32_t record = 0;  // Instruction::leaf
  std::uint32_t node = 0;    // in Scene::nodes

  double distance(const dvec3& p) const { return shape_distance(shape, to_local.vector(p - anchor), size); }
};

// The parameters of one use of an operator.
struct Operation {
  Operator op = Operator::kSum;
  double exponent = 1;
  operators::Opening opening{};
  operators::Silhouette silhouette;
  // The largest range below: gradients are measured against 1 / length to tell whether they vanish.
  double length = 1;
  // M(a, b) <= a + bound b.
  double silhouette_bound = 0;
  std::uint32_t record = 0;  // Instruction::operation: one vec4 each
};

struct Tape {
  std::vector<Instruction> code;
  std::vector<Leaf> leaves;
  std::vector<Operation> operations;
  std::uint32_t leaf_records = 0;  // vec4s in the leaf buffer
  std::uint32_t stack_depth = 0;   // values waiting beside the accumulator, at most
  // A bit per Operand and per Operator that the code, or what the pruner leaves of it, may hold.
  std::uint32_t operand_set = 0;
  std::uint32_t operator_set = 0;
  Box support;  // of the root; empty for a field that is 0 everywhere
};

// Named registers of the interpreter beside the accumulator.
inline constexpr std::uint32_t kMaxStackDepth = 16;

}  // namespace isofield::blobtree
