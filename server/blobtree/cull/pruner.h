// Pruner prunes a tape to what is alive in a box: leaves whose field is 0 there drop out, and so do operators that are
// left with one operand. The pruned tape gives the same bits as the whole one at every point of the box: where one
// operand is 0, a union is the other operand unchanged, and the results of the other forms are known as well.
#pragma once

#include <vector>

#include "blobtree/cull/intervals.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Pruned tells what is left of a tape in a box. `range` bounds the field there.
struct Pruned {
  Interval range;
  // This is true for a positive field that is 0 throughout, which has no code.
  bool is_zero = false;
};

class Pruner {
 public:
  // `tape` must outlive the pruner. Only one thread may use a pruner at a time.
  explicit Pruner(const Tape& tape) : tape_(tape) {}

  // Appends to `out` the part of source[begin, begin + count) that is alive in the box, and returns bounds of the field
  // there. `out` may be `source`. The bounds hold for the device's float32 results, too.
  Pruned prune(const std::vector<Instruction>& source, std::size_t begin, std::size_t count, const Box& box,
               std::vector<Instruction>& out);

 private:
  // A Value is an operand whose code starts at `begin` in the output. A positive operand that is 0 throughout has no
  // code.
  struct Value {
    Interval range;
    std::size_t begin;
    bool is_zero = false;
  };
  // Fills the range of a leaf over the box, and whether the leaf is 0 there.
  static void bound_leaf(const Leaf& leaf, const Box& box, const CentredBox& centred, Value& value);
  // Combines the value on top of the stack with the right operand of i: a leaf fused into i, or (`fused` false) a value
  // whose code has been appended already.
  void join(const Instruction& i, const Value& right, bool fused, std::vector<Instruction>& out);
  // convert() applies a conversion to the value on top of the stack. join_all() applies an operator to as many values
  // as its mask says.
  void convert(const Instruction& i, std::vector<Instruction>& out);
  void join_all(const Instruction& i, std::vector<Instruction>& out);

  const Tape& tape_;
  std::vector<Value> stack_;
};

}  // namespace isofield::blobtree
