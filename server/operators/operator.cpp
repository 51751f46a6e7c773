#include "operators/operator.h"

#include <algorithm>

namespace isofield::operators {

bool Operator::has_angular_ranges() const {
  return visit([]<class K>(const K& k) {
    if constexpr (requires { k.elimination; }) {
      return k.elimination.is_on;
    } else {
      return false;
    }
  });
}

OperandCount Operator::operand_count() const {
  OperandCount count = visit([](const auto& k) { return k.operand_count(); });
  // A difference needs something to take away.
  if (form == Form::kDifference) count.least = std::max<std::size_t>(count.least, 2);
  return count;
}

bool Operator::is_ordered() const {
  return form == Form::kDifference || visit([](const auto& k) { return k.is_ordered(); });
}

bool Operator::may_crease() const {
  return visit([](const auto& k) { return k.may_crease(); });
}

Opcode Operator::opcode(Law law) const {
  return visit([&](const auto& k) { return k.opcode(law); });
}

double Operator::weight(std::size_t operand) const {
  return visit([&]<class K>(const K& k) {
    if constexpr (requires { k.weight(operand); }) {
      return k.weight(operand);
    } else {
      return 1.0;
    }
  });
}

const Opening* Operator::opening() const {
  return visit([]<class K>(const K& k) -> const Opening* {
    if constexpr (IsSteered<K>) {
      return &k.opening;
    } else {
      return nullptr;
    }
  });
}

VolumeKey Operator::volume_key() const {
  return visit([]<class K>(const K& k) {
    if constexpr (IsSteered<K>) {
      return k.volume_key();
    } else {
      return VolumeKey{};
    }
  });
}

}  // namespace isofield::operators
