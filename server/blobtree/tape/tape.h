// A Tape is a scene compiled for evaluation: a flat program in postfix order whose instructions each fuse a leaf with
// the operator that takes it. An indexed stack and unfused leaves are many times slower (engine notes).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "blobtree/geometry/affine.h"
#include "blobtree/geometry/box.h"
#include "blobtree/primitives/leaf.h"
#include "blobtree/tape/code_set.h"
#include "operators/operator.h"

namespace isofield::blobtree {

using operators::Opcode;

// Codes is what the instructions of a tape may hold, before and after pruning. A kernel is specialised to it.
struct Codes {
  CodeSet<Operand> operands;
  CodeSet<Opcode> opcodes;
  // Each flag is a property of the tape that is not an opcode or an operand.
  enum Flag : std::uint32_t {
    kSignedLeaves = 1,     // some leaf's field is signed
    kModes = 2,            // some instruction has a mode
    kByAngle = 4,          // some range follows the angle between gradients
    kFramed = 8,           // angles are measured in Operation::frame
    kSampledOpenings = 16  // some opening is given by samples
  };
  std::uint32_t flags = 0;
  auto operator<=>(const Codes&) const = default;
};

// Mode says how an instruction applies its operator. It stands in bits 16 and up of the instruction's code.
struct Mode {
  operators::Form form = operators::Form::kUnion;
  bool is_signed = false;     // complements are -f rather than 1 - f
  bool is_exchanged = false;  // the accumulator is the second operand

  std::uint32_t bits() const {
    // A union of two operands in their order has the mode 0.
    return static_cast<std::uint32_t>(form) | (is_signed && form != operators::Form::kUnion ? 4u : 0u) |
           (is_exchanged ? 8u : 0u);
  }
};

// The device reads an Instruction as 16 bytes.
struct Instruction {
  std::uint32_t code;       // operand | opcode << 8 | mode << 16
  std::uint32_t leaf;       // place of the leaf's record in the leaf buffer, in vec4s; or the mask of operands present
  std::uint32_t operation;  // place of the operator's record in the operator buffer, in vec4s
  std::uint32_t index;      // host only: index in Tape::leaves (leaf operands)

  Operand operand() const { return static_cast<Operand>(code & 0xff); }
  Opcode op() const { return static_cast<Opcode>(code >> 8 & 0xff); }
  Mode mode() const {
    const std::uint32_t bits = code >> 16;
    return {static_cast<operators::Form>(bits & 3), (bits & 4) != 0, (bits & 8) != 0};
  }
  bool is_leaf() const { return blobtree::is_leaf(operand()); }
};
inline Instruction instruction(Operand operand, Opcode op, std::uint32_t leaf = 0, std::uint32_t operation = 0,
                               std::uint32_t index = 0, Mode mode = {}) {
  return {static_cast<std::uint32_t>(operand) | static_cast<std::uint32_t>(op) << 8 | mode.bits() << 16, leaf,
          operation, index};
}

// An Operation has the parameters of one use of an operator.
struct Operation {
  Opcode op = Opcode::kSum;
  operators::Law law = operators::Law::kPositive;   // law of the operands
  std::shared_ptr<const operators::Operator> what;  // null for kLinear and kSoften
  // For steered blends this is the largest range below. Gradients are compared with 1 / length to tell whether they
  // vanish. Its unit is that of `frame` if there is one, else that of the world.
  double length = 1;
  // Operators that follow an angle measure it in their node's own frame. If a transform that is no similarity stands
  // above one of them, all of them in the scene have a frame.
  std::optional<Affine::LowerTriangle> frame;
  double growth = 0;              // steered blends: growth() of the kind, which bound() takes
  double factor = 1, offset = 0;  // kLinear: factor f + offset
  double range = 1;               // kSoften
  std::uint32_t volume_slot = 0;  // only for operators that are looked up in a volume
  std::uint32_t operands = 0;     // only for operators that take all operands at once
  std::uint32_t node = 0;         // index in Scene::nodes
  std::uint32_t record = 0;       // value of Instruction::operation: the vec4 after those of the frame
  // Returns the place of the first vec4 that the operator buffer holds of the operation: its frame, or its record if it
  // has no frame.
  std::uint32_t begin() const { return record - frame_size(); }
  std::uint32_t frame_size() const { return frame ? 2 : 0; }
};

struct Tape {
  std::vector<Instruction> code;
  std::vector<Leaf> leaves;
  std::vector<Operation> operations;
  std::vector<std::uint32_t> record_owners;  // the operation that each vec4 of the operator buffer belongs to
  std::uint32_t leaf_records = 0;            // vec4s in the leaf buffer
  std::uint32_t stack_depth = 0;             // most values that wait beside the accumulator
  Codes codes;
  operators::Law law = operators::Law::kPositive;  // law of the root's field
  // For a positive root, the box holds its support, and is empty if the field is 0 everywhere. For a signed root, it
  // holds the solid.
  Box support;
  // Each slot holds one operator of a volume that the operations read. There are at most kMaxVolumes.
  std::vector<std::shared_ptr<const operators::Operator>> volumes;
  std::uint32_t arity = 0;  // most operands of one operator that takes all of them at once

  const Operation& operation(const Instruction& i) const { return operations[record_owners[i.operation]]; }
  // Returns the factor and offset of a kLinear: its own, or those of the operand that alone is left of a blend.
  std::pair<double, double> linear(const Instruction& i) const;
};

// Returns how many vec4s the operator buffer holds of an operation, its frame included.
std::uint32_t operation_record_size(const Operation& operation);

// The interpreter has this many named registers beside the accumulator.
inline constexpr std::uint32_t kMaxStackDepth = 16;

}  // namespace isofield::blobtree
