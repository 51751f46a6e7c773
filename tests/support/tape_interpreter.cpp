#include "support/tape_interpreter.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace isofield::test_support {
namespace {

using blobtree::Instruction;
using blobtree::NodeKind;
using blobtree::Operand;
using blobtree::Operator;
using reference::FieldState;

NodeKind kind_of(Operator op) {
  switch (op) {
    case Operator::kSum:
      return NodeKind::kSum;
    case Operator::kMax:
      return NodeKind::kMax;
    case Operator::kMin:
      return NodeKind::kMin;
    case Operator::kSubtract:
    case Operator::kSubtractFrom:
      return NodeKind::kDifference;
    case Operator::kRicci:
      return NodeKind::kRicci;
    default:
      return NodeKind::kGradient;
  }
}

[[noreturn]] void die(const char* message) {
  std::fprintf(stderr, "%s\n", message);
  std::abort();
}

}  // namespace

FieldState TapeInterpreter::leaf(const Instruction& i, const blobtree::dvec3& p) const {
  if (!i.is_leaf()) return {};  // Operand::kZero
  const blobtree::Leaf& leaf = tape_.leaves.at(i.index);
  return reference::evaluate_primitive({leaf.shape, leaf.size, leaf.range, leaf.to_local, leaf.anchor}, p);
}

FieldState TapeInterpreter::evaluate(std::span<const Instruction> code, const blobtree::dvec3& p) {
  waiting_.clear();
  FieldState acc;
  bool empty = true;  // acc holds no value yet
  for (const Instruction& i : code) {
    if (i.op() == Operator::kPush) {
      if (!empty) waiting_.push_back(acc);
      most_waiting_ = std::max(most_waiting_, waiting_.size());
      acc = leaf(i, p);
      empty = false;
      continue;
    }
    // A popped value is the left operand: its code came first.
    FieldState right = acc;
    if (i.operand() == Operand::kPop) {
      if (waiting_.empty()) die("a tape pops a value that is not there");
      acc = waiting_.back();
      waiting_.pop_back();
    } else {
      right = leaf(i, p);
    }
    const blobtree::Operation& o = tape_.operations.at(i.operation);
    const reference::OperatorUse use{kind_of(i.op()), o.exponent, &o.opening, &o.silhouette, o.length};
    acc = i.op() == Operator::kSubtractFrom ? combine(use, right, acc) : combine(use, acc, right);
  }
  if (!waiting_.empty()) die("a tape leaves values waiting");
  return acc;
}

}  // namespace isofield::test_support
