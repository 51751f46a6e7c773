// A scene compiled for evaluation: a flat program in postfix order whose instructions each fuse a leaf with the
// operator that takes it (engine notes: an indexed stack and unfused leaves are many times slower).
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "blobtree/geometry/affine.h"
#include "blobtree/primitives/distance.h"
#include "operators/operator.h"

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
  kGradientVolume = 9,
  kClean = 10,
  kBarthe = 11,
  kBernhardt = 12,
  kPasko = 13,  // the union of R-functions, too
  kFunctional = 14,
  kBt2 = 15,
  // Of as many values as the instruction's mask (Instruction::leaf) has bits; operand kZero.
  kSuperelliptic = 16,
  kBtk = 17,
  // Of the accumulator alone; operand kZero.
  kLinear = 18,  // acc = a acc + b
  kSoften = 19,
};

// Bits of operand_set and operator_set beside those of the opcodes.
inline constexpr std::uint32_t kSignedLeaves = 1u << 31;     // operand_set
inline constexpr std::uint32_t kModes = 1u << 31;            // operator_set: some instruction has a mode
inline constexpr std::uint32_t kByAngle = 1u << 30;          // operator_set: some range follows the angle of gradients
inline constexpr std::uint32_t kFramed = 1u << 29;           // operator_set: angles are measured in Operation::frame
inline constexpr std::uint32_t kSampledOpenings = 1u << 28;  // operator_set: some opening is given by samples

// How an instruction applies its operator; bits 16 and up of its code.
struct Mode {
  operators::Form form = operators::Form::kUnion;
  bool is_signed = false;     // complements are -f rather than 1 - f
  bool is_exchanged = false;  // the accumulator is the second operand

  std::uint32_t bits() const {
    // Unions of two in their order have mode 0.
    return static_cast<std::uint32_t>(form) | (is_signed && form != operators::Form::kUnion ? 4u : 0u) |
           (is_exchanged ? 8u : 0u);
  }
};

// As the device reads it: 16 bytes.
struct Instruction {
  std::uint32_t code;       // operand | operator << 8 | mode << 16
  std::uint32_t leaf;       // place of the leaf's record in the leaf buffer, in vec4; or the mask of operands present
  std::uint32_t operation;  // place of the operator's record in the operator buffer, in vec4
  std::uint32_t index;      // host only: the leaf in Tape::leaves (leaf operands)

  Operand operand() const { return static_cast<Operand>(code & 0xff); }
  Operator op() const { return static_cast<Operator>(code >> 8 & 0xff); }
  Mode mode() const {
    const std::uint32_t bits = code >> 16;
    return {static_cast<operators::Form>(bits & 3), (bits & 4) != 0, (bits & 8) != 0};
  }
  bool is_leaf() const { return operand() >= Operand::kSphere; }
};
inline Instruction instruction(Operand operand, Operator op, std::uint32_t leaf = 0, std::uint32_t operation = 0,
                               std::uint32_t index = 0, Mode mode = {}) {
  return {static_cast<std::uint32_t>(operand) | static_cast<std::uint32_t>(op) << 8 | mode.bits() << 16, leaf,
          operation, index};
}

struct Box {
  dvec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  dvec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Box& other);
  bool operator==(const Box&) const = default;
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
  double stretch = 1;  // most that to_local stretches: bounds the slope of the distance
  operators::Law law = operators::Law::kPositive;
  double per_distance = 1;  // signed: the field is the distance times this
  // Positive: holds every point where the field is not 0, with room for float32 rounding. Signed: the shape itself.
  Box support;
  double growth = 1;         // signed: where the field is at most r, the box grown by r times this holds the point
  std::uint32_t record = 0;  // Instruction::leaf
  std::uint32_t node = 0;    // in Scene::nodes

  double distance(const dvec3& p) const { return shape_distance(shape, to_local.vector(p - anchor), size); }
};

// The parameters of one use of an operator.
struct Operation {
  Operator op = Operator::kSum;
  std::shared_ptr<const operators::Operator> what;  // all but kLinear and kSoften
  // Gradient blends: the largest range below; gradients are measured against 1 / length to tell whether they vanish. In
  // the unit of `frame` where there is one, else in the world's.
  double length = 1;
  // Operators that follow an angle measure it in their node's own frame. Set in every such operator of a scene where a
  // transform that is no similarity stands above one of them.
  std::optional<Affine::LowerTriangle> frame;
  // Gradient blends: M(a, b) <= a + bound b.
  double silhouette_bound = 0;
  double factor = 1, offset = 0;  // kLinear
  double range = 1;               // kSoften
  std::uint32_t volume_slot = 0;  // kGradientVolume
  std::uint32_t operands = 0;     // kSuperelliptic, kBtk
  std::uint32_t node = 0;         // in Scene::nodes
  std::uint32_t record = 0;       // Instruction::operation: the vec4 after those of the frame
  // The first vec4 that the operator buffer holds of it: its frame, or its record where it has none.
  std::uint32_t begin() const { return record - frame_size(); }
  std::uint32_t frame_size() const { return frame ? 2 : 0; }
};

struct Tape {
  std::vector<Instruction> code;
  std::vector<Leaf> leaves;
  std::vector<Operation> operations;
  std::vector<std::uint32_t> record_owners;  // by vec4 of the operator buffer: the operation that it belongs to
  std::uint32_t leaf_records = 0;            // vec4s in the leaf buffer
  std::uint32_t stack_depth = 0;             // values waiting beside the accumulator, at most
  // A bit per Operand and per Operator that the code, or what the pruner leaves of it, may hold.
  std::uint32_t operand_set = 0;
  std::uint32_t operator_set = 0;
  operators::Law law = operators::Law::kPositive;  // of the root
  // Of the root. Positive: holds its support; empty for a field that is 0 everywhere. Signed: holds its solid.
  Box support;
  // One operator of each volume that the operations read, by slot: at most kMaxVolumes.
  std::vector<std::shared_ptr<const operators::Operator>> volumes;
  std::uint32_t arity = 0;  // most operands of a kSuperelliptic or kBtk

  const Operation& operation(const Instruction& i) const { return operations[record_owners[i.operation]]; }
  // The factor and offset of a kLinear: its own, or those of an operand that alone is left of a blend.
  std::pair<double, double> linear(const Instruction& i) const;
};

// How many vec4s the operator buffer holds of an operation, its frame included. kSuperelliptic and kBtk have one for each
// operand, whose first two numbers are the factor and offset of a kLinear.
std::uint32_t operation_record_size(const Operation& operation);

// Named registers of the interpreter beside the accumulator.
inline constexpr std::uint32_t kMaxStackDepth = 16;

}  // namespace isofield::blobtree
