// These functions make Operations, which are what a tape holds of operators.
#pragma once

#include <memory>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Makes an operation of an operator on `operands` fields of `law`, which is not in a tape yet. `silhouettes` keeps the
// bounds of silhouettes for further calls.
Operation operation_of(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands,
                       operators::SilhouetteBounds& silhouettes);

// Adds an operation to the tape with a record of its own, and returns its index in Tape::operations.
std::uint32_t add_operation(Tape& tape, Operation operation);

// Adds the opcodes, operands and flags that an instruction of this operation may hold, before and after pruning.
void add_codes(Tape& tape, const Operation& operation, const Mode& mode);

// Returns a tape of one instruction, which applies an operator to operands that the kernel supplies.
Tape operator_tape(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands);

}  // namespace isofield::blobtree
