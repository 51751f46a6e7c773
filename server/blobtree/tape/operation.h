// From an operator to what a tape holds of it.
#pragma once

#include <map>
#include <memory>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Bounds of the silhouettes seen so far: each takes a few hundred evaluations.
using SilhouetteBounds = std::map<operators::Silhouette, double>;

// Of an operator on `operands` fields of `law`; not yet in a tape.
Operation operation_of(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands,
                       SilhouetteBounds& bounds);

// Gives it a record; returns its place in Tape::operations.
std::uint32_t add_operation(Tape& tape, Operation operation);

// The opcodes that an instruction of this operation, or what the pruner leaves of it, may hold.
void add_sets(Tape& tape, const Operation& operation, const Mode& mode);

// Whether it makes a difference which of two operands is the first, in the union.
bool is_ordered(const operators::Operator& op);

// A tape of one instruction that applies an operator to operands which the kernel supplies.
Tape operator_tape(std::shared_ptr<const operators::Operator> op, operators::Law law, std::uint32_t operands);

}  // namespace isofield::blobtree
