// From an operator to what a tape holds of it.
#pragma once

#include <memory>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Of an operator on `operands` fields of `law`; not yet in a tape.
Operation operation_of(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands,
                       operators::SilhouetteBounds& silhouettes);

// Gives it a record; returns its place in Tape::operations.
std::uint32_t add_operation(Tape& tape, Operation operation);

// Adds what an instruction of this operation, or what the pruner leaves of it, may hold.
void add_codes(Tape& tape, const Operation& operation, const Mode& mode);

// A tape of one instruction that applies an operator to operands which the kernel supplies.
Tape operator_tape(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands);

}  // namespace isofield::blobtree
