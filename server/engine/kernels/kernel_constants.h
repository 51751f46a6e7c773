// The numbers and names of the specialisation constants of kernels that run tapes. shaders/generators/code_texts.cpp
// writes the shaders' declarations from them.
#pragma once

#include <array>
#include <cstdint>

#include "blobtree/primitives/primitive.h"
#include "blobtree/tape/code_set.h"
#include "operators/operator.h"

namespace isofield::engine {

// The first constants. The words of the set of operands follow them, then those of the set of opcodes.
enum class KernelConstant {
  kFlags,        // blobtree::Codes::Flag
  kOnlyOperand,  // the one leaf that all instructions have, or kNone where they differ
  kOnlyOpcode,   // the one opcode of all instructions after the first, which pushes; or kNone where they differ
  kStackDepth,   // the most values that wait beside the accumulator
  kTapeLength,   // instructions of every tape, or 0 where they differ
  kArity,        // most operands of an operator that takes all of them at once
  kVolumeSet,    // the slots of volumes that are read, a bit each
  kUniformSet,   // parameters in uniform buffers. 1: leaves, 2: operations, 4: tape; 8, with all: invocations share
                 // loads
  kCount
};
inline constexpr std::array kKernelConstantNames{"CODE_FLAGS",  "ONLY_OPERAND", "ONLY_OPERATOR", "STACK_DEPTH",
                                                 "TAPE_LENGTH", "ARITY",        "VOLUME_SET",    "UNIFORM_SET"};
static_assert(kKernelConstantNames.size() == static_cast<std::size_t>(KernelConstant::kCount));
inline constexpr std::uint32_t kNone = 0xff;

inline constexpr std::size_t kOperandWords = blobtree::CodeSet<blobtree::Operand>::kUsedWords;
inline constexpr std::size_t kOpcodeWords = blobtree::CodeSet<operators::Opcode>::kUsedWords;
// The name of a word is one of these, followed by the word's number.
inline constexpr const char* kOperandWordName = "OPERAND_SET_";
inline constexpr const char* kOpcodeWordName = "OPERATOR_SET_";

using KernelConstants =
    std::array<std::uint32_t, static_cast<std::size_t>(KernelConstant::kCount) + kOperandWords + kOpcodeWords>;

}  // namespace isofield::engine
