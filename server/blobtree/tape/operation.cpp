#include "blobtree/tape/operation.h"

#include "operators/profile_table.h"

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Kind;
using operators::Law;

std::uint32_t bit(Operator op) {
  return 1u << static_cast<std::uint32_t>(op);
}
std::uint32_t bit(Operand operand) {
  return 1u << static_cast<std::uint32_t>(operand);
}

double bound_of(const operators::Silhouette& silhouette, SilhouetteBounds& bounds) {
  const auto [known, is_new] = bounds.try_emplace(silhouette);
  if (is_new) known->second = operators::silhouette_bound(silhouette);
  return known->second;
}

Operator opcode_of(const operators::Operator& op, Law law) {
  switch (op.kind) {
    case Kind::kSum:
      return Operator::kSum;
    case Kind::kMax:
      return Operator::kMax;
    case Kind::kMin:
      return Operator::kMin;
    case Kind::kDifference:
      // max(x1, -x2) = -min(-x1, x2).
      return law == Law::kSigned ? Operator::kMin : Operator::kSubtract;
    case Kind::kRicci:
      return Operator::kRicci;
    case Kind::kGradient:
      if (op.has_volume()) return Operator::kGradientVolume;
      return op.silhouette.kind == operators::Silhouette::Kind::kSmooth ? Operator::kGradient
                                                                        : Operator::kGradientTable;
    case Kind::kSampled:
      return Operator::kGradientVolume;
    case Kind::kClean:
      return Operator::kClean;
    case Kind::kBarthe:
      return Operator::kBarthe;
    case Kind::kBernhardt:
      return Operator::kBernhardt;
    case Kind::kRUnion:
    case Kind::kPasko:
      return Operator::kPasko;
    case Kind::kSuperelliptic:
      return Operator::kSuperelliptic;
    case Kind::kFunctional:
      return Operator::kFunctional;
    case Kind::kBt2:
      return Operator::kBt2;
    case Kind::kBtk:
      return Operator::kBtk;
  }
  return Operator::kMax;
}

std::uint32_t slot_of(Tape& tape, const std::shared_ptr<const operators::Operator>& op) {
  std::uint32_t slot = 0;
  while (slot < tape.volumes.size() && operators::volume_key(*tape.volumes[slot]) != operators::volume_key(*op)) ++slot;
  if (slot == tape.volumes.size()) tape.volumes.push_back(op);
  return slot;
}

}  // namespace

Operation operation_of(std::shared_ptr<const operators::Operator> op, Law law, std::uint32_t operands,
                       SilhouetteBounds& bounds) {
  Operation o;
  o.op = opcode_of(*op, law);
  if (op->kind == Kind::kGradient) o.silhouette_bound = bound_of(op->silhouette, bounds);
  if (op->kind == Kind::kSampled) o.silhouette_bound = operators::sampled_bound(*op->samples);
  if (op->is_n_ary()) o.operands = operands;
  o.what = std::move(op);
  return o;
}

std::uint32_t operation_record_size(const Operation& operation) {
  switch (operation.op) {
    case Operator::kBt2:
      return operation.frame_size() + 3;
    case Operator::kSuperelliptic:
    case Operator::kBtk:
      return operation.frame_size() + 1 + operation.operands;
    default:
      return operation.frame_size() + 1;
  }
}

std::uint32_t add_operation(Tape& tape, Operation operation) {
  const auto place = static_cast<std::uint32_t>(tape.operations.size());
  const std::size_t begin = tape.record_owners.size();
  operation.record = static_cast<std::uint32_t>(begin) + operation.frame_size();
  tape.record_owners.resize(begin + operation_record_size(operation), place);
  if (operation.op == Operator::kGradientVolume) operation.volume_slot = slot_of(tape, operation.what);
  tape.operations.push_back(std::move(operation));
  return place;
}

void add_sets(Tape& tape, const Operation& o, const Mode& mode) {
  tape.operator_set |= bit(o.op);
  if (mode.bits() != 0) tape.operator_set |= kModes;
  if (o.what && o.what->by_angle) tape.operator_set |= kByAngle;
  if (o.frame) tape.operator_set |= kFramed;
  if (o.what && !o.what->opening.samples.empty()) tape.operator_set |= kSampledOpenings;
  const bool is_positive_difference = mode.form == Form::kDifference && !mode.is_signed;
  if (o.op == Operator::kSubtract || is_positive_difference) {
    // Where the subtrahend is gone, the pruner clamps fields above 1 by subtracting 0.
    tape.operand_set |= bit(Operand::kZero);
    tape.operator_set |= bit(Operator::kSubtract);
  }
  // What remains of a blend with weights beyond its range is one operand over its weight; what remains of a positive
  // field that is made signed, 0.5 less 0.
  if (o.op == Operator::kBt2 || o.op == Operator::kBtk || o.op == Operator::kLinear) {
    tape.operator_set |= bit(Operator::kLinear);
    tape.operand_set |= bit(Operand::kZero);
  }
}

bool is_ordered(const operators::Operator& op) {
  switch (op.kind) {
    case Kind::kBarthe:
    case Kind::kBernhardt:
    case Kind::kPasko:
    case Kind::kBt2:
      return true;
    case Kind::kGradient:
      if (!op.silhouette.is_symmetric()) return true;
      break;
    case Kind::kSampled:
      return true;
    default:
      break;
  }
  return op.form == Form::kDifference;
}

Tape operator_tape(std::shared_ptr<const operators::Operator> op, Law law, std::uint32_t operands) {
  Tape tape;
  SilhouetteBounds bounds;
  Mode mode{op->applied_form(), law == Law::kSigned, false};
  Operation o = operation_of(std::move(op), law, operands, bounds);
  if (o.op == Operator::kSubtract) mode = {};
  const bool n_ary = o.operands > 0;
  tape.arity = o.operands;
  add_sets(tape, o, mode);
  const std::uint32_t place = add_operation(tape, std::move(o));
  const Operation& added = tape.operations[place];
  tape.code.push_back(instruction(n_ary ? Operand::kZero : Operand::kPop, added.op, n_ary ? (1u << operands) - 1 : 0,
                                  added.record, 0, mode));
  tape.operator_set |= bit(Operator::kPush);
  tape.law = law;
  return tape;
}

}  // namespace isofield::blobtree
