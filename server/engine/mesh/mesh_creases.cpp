#include "engine/mesh/mesh_creases.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/mesh/mesh_lattice.h"
#include "operators/operator.h"

namespace isofield::engine {
namespace {

using blobtree::Instruction;
using blobtree::Operand;
using blobtree::Operator;

// At 45 degrees a blend is the sharp union; from here on it is sharper than cells show.
constexpr double kSharp = 44 * std::numbers::pi / 180;

bool is_sharp(const operators::Opening& opening) {
  for (int degrees = 30; degrees <= 150; degrees += 5) {
    if (opening.theta(degrees * std::numbers::pi / 180).v > kSharp) return true;
  }
  return false;
}

bool may_crease(const blobtree::Operation& operation) {
  switch (operation.op) {
    case Operator::kPush:
    case Operator::kSum:
    case Operator::kLinear:
    case Operator::kSoften:
      return false;
    case Operator::kGradient:
      return is_sharp(operation.what->opening);
    default:
      return true;
  }
}

bool may_crease(Operand leaf) {
  return leaf == Operand::kBox || leaf == Operand::kCylinder;
}

// The tape's operations that make creases, by their places.
std::vector<char> creasing_operations(const blobtree::Tape& tape) {
  std::vector<char> found;
  found.reserve(tape.operations.size());
  for (std::size_t i = 0; i < tape.operations.size(); ++i) {
    const bool is_repeated = i > 0 && tape.operations[i].what == tape.operations[i - 1].what &&
                             tape.operations[i].op == tape.operations[i - 1].op;
    found.push_back(is_repeated ? found.back() : may_crease(tape.operations[i]));
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> brick_kinds(const blobtree::Tape& tape, const blobtree::BrickList& list,
                                       const std::vector<std::uint32_t>& neighbours) {
  const std::vector<char> creasing = creasing_operations(tape);
  const auto creases = [&](const Instruction& i) {
    if (may_crease(i.operand()) || i.mode().form != operators::Form::kUnion) return true;
    switch (i.op()) {
      case Operator::kGradient:
        return creasing[tape.record_owners[i.operation]] != 0;
      default:
        return may_crease(blobtree::Operation{.op = i.op()});
    }
  };
  std::vector<std::uint32_t> kinds(list.bricks.size(), 0);
  for (std::size_t b = 0; b < list.bricks.size(); ++b) {
    const auto begin = list.code.begin() + list.bricks[b].tape_begin;
    if (!std::any_of(begin, begin + list.bricks[b].tape_count, creases)) continue;
    kinds[b] |= kMayCrease | kKnowsCrossings;
    // Edges at the upper faces of a brick belong to those above.
    for (const std::size_t slot : kNeighboursAbove) {
      const std::uint32_t above = neighbours[kNeighbours * b + slot];
      if (above != ~0u) kinds[above] |= kKnowsCrossings;
    }
  }
  return kinds;
}

}  // namespace isofield::engine
