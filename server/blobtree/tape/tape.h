// A scene compiled for evaluation: a flat program in postfix order whose instructions each fuse a leaf with the
// operator that takes it (engine notes: an indexed stack and unfused leaves are many times slower).
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

// What the instructions of a tape, or what the pruner leaves of them, may hold: what a kernel is specialised to.
struct Codes {
  CodeSet<Operand> operands;
  CodeSet<Opcode> opcodes;
  // A bit each for what is no code of its own.
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
  std::uint32_t code;       // operand | opcode << 8 | mode << 16
  std::uint32_t leaf;       // place of the leaf's record in the leaf buffer, in vec4; or the mask of operands present
  std::uint32_t operation;  // place of the operator's record in the operator buffer, in vec4
  std::uint32_t index;      // host only: the leaf in Tape::leaves (leaf operands)

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

// The parameters of one use of an operator.
struct Operation {
  Opcode op = Opcode::kSum;
  operators::Law law = operators::Law::kPositive;   // of the operands
  std::shared_ptr<const operators::Operator> what;  // all but kLinear and kSoften
  // Steered blends: the largest range below; gradients are measured against 1 / length to tell whether they vanish. In
  // the unit of `frame` where there is one, else in the world's.
  double length = 1;
  // Operators that follow an angle measure it in their node's own frame. Set in every such operator of a scene where a
  // transform that is no similarity stands above one of them.
  std::optional<Affine::LowerTriangle> frame;
  double growth = 0;              // steered blends: the least c with g(a, b) <= max(a, b) + c min(a, b)
  double factor = 1, offset = 0;  // kLinear: factor f + offset
  double range = 1;               // kSoften
  std::uint32_t volume_slot = 0;  // operators that are looked up in a volume
  std::uint32_t operands = 0;     // operators that take all of them at once
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
  Codes codes;
  operators::Law law = operators::Law::kPositive;  // of the root
  // Of the root. Positive: holds its support; empty for a field that is 0 everywhere. Signed: holds its solid.
  Box support;
  // One operator of each volume that the operations read, by slot: at most kMaxVolumes.
  std::vector<std::shared_ptr<const operators::Operator>> volumes;
  std::uint32_t arity = 0;  // most operands of an operator that takes all of them at once

  const Operation& operation(const Instruction& i) const { return operations[record_owners[i.operation]]; }
  // The factor and offset of a kLinear: its own, or those of an operand that alone is left of a blend.
  std::pair<double, double> linear(const Instruction& i) const;
};

// How many vec4s the operator buffer holds of an operation, its frame included.
std::uint32_t operation_record_size(const Operation& operation);

// Named registers of the interpreter beside the accumulator.
inline constexpr std::uint32_t kMaxStackDepth = 16;

}  // namespace isofield::blobtree
