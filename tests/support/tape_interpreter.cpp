#include "support/tape_interpreter.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>

namespace isofield::test_support {
namespace {

using blobtree::Instruction;
using blobtree::Operand;
using reference::FieldState;

[[noreturn]] void die(const char* message) {
  std::fprintf(stderr, "%s\n", message);
  std::abort();
}

FieldState linear(const FieldState& a, double factor, double offset) {
  using reference::Dual;
  const Dual s(factor);
  return {a.field * s + Dual(offset), {a.steering.x * s, a.steering.y * s, a.steering.z * s}};
}

// Returns the operator of an instruction, with only those operands that the instruction's mask keeps.
operators::Operator operator_of(const Instruction& i, const blobtree::Operation& o) {
  if (i.op() == operators::Opcode::kSubtract || i.op() == operators::Opcode::kSubtractFrom) {
    return operators::Difference{};
  }
  operators::Operator op = *o.what;
  std::visit(
      [&]<class K>(K& kind) {
        if constexpr (operators::IsJoint<K>) {
          const K whole = kind;
          kind.terms.clear();
          for (std::uint32_t k = 0; k < o.operands; ++k) {
            if (i.leaf >> k & 1) kind.terms.push_back(whole.term(k));
          }
        }
      },
      op.parameters);
  return op;
}

}  // namespace

FieldState TapeInterpreter::leaf(const Instruction& i, const blobtree::dvec3& p) const {
  if (!i.is_leaf()) return {};  // Operand::kZero
  const blobtree::Leaf& leaf = tape_.leaves.at(i.index);
  const FieldState v = reference::evaluate_primitive(
      {leaf.shape, leaf.range, leaf.law, leaf.domain.to_local, leaf.domain.anchor, leaf.domain.to_local}, p);
  return leaf.law == operators::Law::kSigned ? linear(v, leaf.per_distance, 0) : v;
}

FieldState TapeInterpreter::evaluate(std::span<const Instruction> code, const blobtree::dvec3& p) {
  waiting_.clear();
  FieldState acc;
  bool empty = true;  // acc holds no value yet
  for (const Instruction& i : code) {
    if (i.op() == operators::Opcode::kPush) {
      if (!empty) waiting_.push_back(acc);
      most_waiting_ = std::max(most_waiting_, waiting_.size());
      acc = leaf(i, p);
      empty = false;
      continue;
    }
    if (i.op() == operators::Opcode::kLinear) {
      const auto [factor, offset] = tape_.linear(i);
      acc = linear(acc, factor, offset);
      continue;
    }
    const blobtree::Operation& o = tape_.operation(i);
    if (i.op() == operators::Opcode::kSoften) {
      acc = reference::soften(acc, o.range);
      continue;
    }
    const operators::Operator op = operator_of(i, o);
    const bool is_signed = op.law() == operators::Law::kSigned || i.mode().is_signed;
    const reference::OperatorUse use{&op, is_signed ? operators::Law::kSigned : operators::Law::kPositive, o.length,
                                     o.frame};
    if (op.is_joint()) {
      std::vector<FieldState> operands{acc};
      while (operands.size() < static_cast<std::size_t>(std::popcount(i.leaf))) {
        if (waiting_.empty()) die("a tape joins a value that is not there");
        operands.insert(operands.begin(), waiting_.back());
        waiting_.pop_back();
      }
      acc = combine(use, operands);
      continue;
    }
    // A popped value is the left operand, because its code came first.
    FieldState right = acc;
    if (i.operand() == Operand::kPop) {
      if (waiting_.empty()) die("a tape pops a value that is not there");
      acc = waiting_.back();
      waiting_.pop_back();
    } else {
      right = leaf(i, p);
    }
    const bool is_exchanged = i.op() == operators::Opcode::kSubtractFrom || i.mode().is_exchanged;
    acc = is_exchanged ? combine(use, {right, acc}) : combine(use, {acc, right});
  }
  if (!waiting_.empty()) die("a tape leaves values waiting");
  return acc;
}

}  // namespace isofield::test_support
