// A tape, or a pruned part of one, evaluated in double precision, instruction by instruction.
#pragma once

#include <span>
#include <vector>

#include "blobtree/tape/tape.h"
#include "reference/field_state.h"

namespace isofield::test_support {

class TapeInterpreter {
 public:
  // `tape` must outlive the interpreter. One thread at a time.
  explicit TapeInterpreter(const blobtree::Tape& tape) : tape_(tape) {}

  // An empty code is the field that is 0 everywhere.
  reference::FieldState evaluate(std::span<const blobtree::Instruction> code, const blobtree::dvec3& p);
  // Values that waited beside the accumulator at once, at most, in all evaluations.
  std::size_t most_waiting() const { return most_waiting_; }

 private:
  reference::FieldState leaf(const blobtree::Instruction& i, const blobtree::dvec3& p) const;

  const blobtree::Tape& tape_;
  std::vector<reference::FieldState> waiting_;
  std::size_t most_waiting_ = 0;
};

}  // namespace isofield::test_support
