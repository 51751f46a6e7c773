#include "blobtree/tape/operation.h"

#include <utility>

namespace isofield::blobtree {
namespace {

using operators::Form;
using operators::Law;

// Returns the slot, among the tape's volumes, of the volume that the operator is looked up in. A new volume is added.
std::uint32_t slot_of(Tape& tape, const std::shared_ptr<const operators::Operator>& op) {
  std::uint32_t slot = 0;
  while (slot < tape.volumes.size() && tape.volumes[slot]->volume_key() != op->volume_key()) ++slot;
  if (slot == tape.volumes.size()) tape.volumes.push_back(op);
  return slot;
}

std::uint32_t own_record_size(const Operation& operation) {
  if (!operation.what) return 1;
  const std::uint32_t operands = operation.operands;
  return operation.what->visit([&](const auto& kind) { return kind.record_size(operands); });
}

double growth_of(const operators::Operator& op, operators::SilhouetteBounds& silhouettes) {
  return op.visit([&]<class K>(const K& kind) {
    if constexpr (operators::IsSteered<K>) {
      return kind.growth(silhouettes);
    } else {
      return 0.0;
    }
  });
}

}  // namespace

Operation operation_of(std::shared_ptr<const operators::Operator> op, Law law, std::uint32_t operands,
                       operators::SilhouetteBounds& silhouettes) {
  Operation o;
  o.op = op->opcode(law);
  o.law = law;
  o.growth = growth_of(*op, silhouettes);
  if (op->is_joint()) o.operands = operands;
  o.what = std::move(op);
  return o;
}

std::uint32_t operation_record_size(const Operation& operation) {
  return operation.frame_size() + own_record_size(operation);
}

std::uint32_t add_operation(Tape& tape, Operation operation) {
  const auto place = static_cast<std::uint32_t>(tape.operations.size());
  const std::size_t begin = tape.record_owners.size();
  operation.record = static_cast<std::uint32_t>(begin) + operation.frame_size();
  tape.record_owners.resize(begin + operation_record_size(operation), place);
  if (operation.what && operation.what->volume_key().size != 0) operation.volume_slot = slot_of(tape, operation.what);
  tape.operations.push_back(std::move(operation));
  return place;
}

void add_codes(Tape& tape, const Operation& o, const Mode& mode) {
  Codes& codes = tape.codes;
  codes.opcodes.add(o.op);
  if (mode.bits() != 0) codes.flags |= Codes::kModes;
  if (o.what && o.what->has_angular_ranges()) codes.flags |= Codes::kByAngle;
  if (o.frame) codes.flags |= Codes::kFramed;
  if (o.what && o.what->opening() && !o.what->opening()->samples.empty()) codes.flags |= Codes::kSampledOpenings;
  const bool is_positive_difference = mode.form == Form::kDifference && !mode.is_signed;
  if (o.op == Opcode::kSubtract || is_positive_difference) {
    // If the subtrahend is gone, the pruner clamps fields above 1 by subtracting 0.
    codes.operands.add(Operand::kZero);
    codes.opcodes.add(Opcode::kSubtract);
  }
  // Pruning may leave one operand of a blend with weights, which is then divided by its weight. It may leave nothing of
  // a positive field that is made signed, which is then 0.5 less 0.
  const bool has_weights = o.what && o.what->visit([](const auto& kind) {
    return requires {
      kind.weight(0);
    };
  });
  if (has_weights || o.op == Opcode::kLinear) {
    codes.opcodes.add(Opcode::kLinear);
    codes.operands.add(Operand::kZero);
  }
}

Tape operator_tape(std::shared_ptr<const operators::Operator> op, Law law, std::uint32_t operands) {
  operators::SilhouetteBounds silhouettes;
  Operation o = operation_of(std::move(op), law, operands, silhouettes);
  Tape tape;
  Mode mode{o.what->form, law == Law::kSigned, false};
  if (o.op == Opcode::kSubtract) mode = {};
  const bool is_joint = o.what->is_joint();
  tape.arity = o.operands;
  add_codes(tape, o, mode);
  const std::uint32_t place = add_operation(tape, std::move(o));
  const Operation& added = tape.operations[place];
  tape.code.push_back(instruction(is_joint ? Operand::kZero : Operand::kPop, added.op,
                                  is_joint ? (1u << operands) - 1 : 0, added.record, 0, mode));
  tape.codes.opcodes.add(Opcode::kPush);
  tape.law = law;
  return tape;
}

}  // namespace isofield::blobtree
