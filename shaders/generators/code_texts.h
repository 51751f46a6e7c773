// Generates the GLSL that follows from the tables of primitives and operators: the numbers of all codes, and the
// functions that call the function of each code.
#pragma once

#include <span>
#include <string>

#include "blobtree/primitives/primitive.h"
#include "operators/operator.h"

namespace isofield::shaders {

using Operands = std::span<const blobtree::OperandTraits>;
using Opcodes = std::span<const operators::OpcodeTraits>;

// The numbers of operands and opcodes, modes, flags and specialisation constants. The macros HAS_OPERAND_NAME and
// HAS_OPERATOR_NAME tell whether a kernel's tapes may hold a code.
std::string codes_text(Operands operands, Opcodes opcodes);

// The function Field leaf_field(vec3 p, uint operand, uint record), which calls the function of each primitive.
std::string leaves_text(Operands operands);

// The functions unite(), unite_steered(), unite_many(), convert() and makes_seams(), which call the functions of the
// opcodes that operators::Applies names.
std::string operators_text(Opcodes opcodes);

}  // namespace isofield::shaders
