// Prunes a tape to what is alive in a box: leaves whose field is 0 there drop out, and so do operators that are left
// with one operand. The pruned tape gives the same bits as the whole one at every point of the box, because every
// operator returns its other operand unchanged where one is 0.
#pragma once

#include <vector>

#include "blobtree/tape.h"

namespace isofield::blobtree {

struct Interval {
  double lo = 0, hi = 0;
};

class Pruner {
 public:
  // `tape` must outlive the pruner. One thread at a time.
  explicit Pruner(const Tape& tape) : tape_(tape) {}

  // Appends to `out` the part of source[begin, begin + count) that is alive in the box and returns bounds of the field
  // there: [0, 0] with nothing appended where it is 0 throughout. `out` may be `source`. The bounds hold for the
  // device's float32 results too.
  Interval prune(const std::vector<Instruction>& source, std::size_t begin, std::size_t count, const Box& box,
                 std::vector<Instruction>& out);

 private:
  // An operand whose code starts at `begin` in the output. One that is 0 throughout has no code.
  struct Value {
    Interval range;
    std::size_t begin;
  };
  Interval leaf_range(const Leaf& leaf, const Box& box, const dvec3& centre, double radius) const;
  // Combines the value on top of the stack with the right operand of i: a leaf fused into i, or (`fused` false) a value
  // whose code has been appended already.
  void join(const Instruction& i, const Value& right, bool fused, std::vector<Instruction>& out);

  const Tape& tape_;
  std::vector<Value> stack_;
};

}  // namespace isofield::blobtree
