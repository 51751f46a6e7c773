// Evaluates a tape, or a pruned part of one, in double precision, instruction by instruction. Tests compare it with the
// reference evaluator of the scene.
#pragma once

#include <span>
#include <vector>

#include "blobtree/tape/tape.h"
#include "reference/field_state.h"

namespace isofield::test_support {

class TapeInterpreter {
 public:
  // `tape` must outlive the interpreter. Only one thread at a time may use the interpreter.
  explicit TapeInterpreter(const blobtree::Tape& tape) : tape_(tape) {}

  // Evaluates `code` at p. An empty code is the field that is 0 everywhere. A malformed code ends the process.
  reference::FieldState evaluate(std::span<const blobtree::Instruction> code, const blobtree::dvec3& p);
  // The largest number of values that waited beside the accumulator at once, in all evaluations.
  std::size_t most_waiting() const { return most_waiting_; }

 private:
  reference::FieldState leaf(const blobtree::Instruction& i, const blobtree::dvec3& p) const;

  const blobtree::Tape& tape_;
  std::vector<reference::FieldState> waiting_;
  std::size_t most_waiting_ = 0;
};

}  // namespace isofield::test_support
