// GLSL that follows from the tables of primitives and of operators: what shaders know of opcodes, and what calls the
// function of each.
#pragma once

#include <span>
#include <string>

#include "blobtree/primitives/primitive.h"
#include "operators/operator.h"

namespace isofield::shaders {

using Operands = std::span<const blobtree::OperandTraits>;
using Opcodes = std::span<const operators::OpcodeTraits>;

// Numbers of operands and opcodes, modes, flags and specialisation constants, with macros that tell whether a kernel's
// tapes may hold a code: HAS_OPERAND_NAME, HAS_OPERATOR_NAME.
std::string codes_text(Operands operands, Opcodes opcodes);

// Field leaf_field(vec3 p, uint operand, uint record).
std::string leaves_text(Operands operands);

// unite(), unite_steered(), unite_many(), convert() and makes_seams(), which call the functions that
// operators::Applies names.
std::string operators_text(Opcodes opcodes);

}  // namespace isofield::shaders
