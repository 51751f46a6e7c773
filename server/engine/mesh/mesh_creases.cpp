#include "engine/mesh/mesh_creases.h"

#include <algorithm>

#include "engine/mesh/mesh_lattice.h"
#include "operators/operator.h"

namespace isofield::engine {
namespace {

using blobtree::Instruction;
using operators::Opcode;

// Returns, for each of the tape's operations in their order, whether it may make a crease.
std::vector<char> creasing_operations(const blobtree::Tape& tape) {
  std::vector<char> found;
  found.reserve(tape.operations.size());
  for (std::size_t i = 0; i < tape.operations.size(); ++i) {
    const auto& what = tape.operations[i].what;
    const bool is_repeated = i > 0 && what == tape.operations[i - 1].what;
    found.push_back(is_repeated ? found.back() : what && what->may_crease());
  }
  return found;
}

// Returns the operands, that is, the kinds of leaves, of which some leaf of the tape may have edges.
blobtree::CodeSet<blobtree::Operand> edged_operands(const blobtree::Tape& tape) {
  blobtree::CodeSet<blobtree::Operand> found;
  for (const blobtree::Leaf& leaf : tape.leaves) {
    if (leaf.may_crease()) found.add(leaf.operand);
  }
  return found;
}

bool is_conversion(Opcode op) {
  return operators::traits_of(op).applies == operators::Applies::kOne;
}

}  // namespace

std::vector<std::uint32_t> brick_kinds(const blobtree::Tape& tape, const blobtree::BrickList& list,
                                       const std::vector<std::uint32_t>& neighbours) {
  const std::vector<char> creasing = creasing_operations(tape);
  const blobtree::CodeSet<blobtree::Operand> edged = edged_operands(tape);
  const auto creases = [&](const Instruction& i) {
    if (edged.has(i.operand()) || i.mode().form != operators::Form::kUnion) return true;
    if (i.op() == Opcode::kPush || is_conversion(i.op())) return false;
    return creasing[tape.record_owners[i.operation]] != 0;
  };
  std::vector<std::uint32_t> kinds(list.bricks.size(), 0);
  for (std::size_t b = 0; b < list.bricks.size(); ++b) {
    const auto begin = list.code.begin() + list.bricks[b].tape_begin;
    if (!std::any_of(begin, begin + list.bricks[b].tape_count, creases)) continue;
    kinds[b] |= kMayCrease | kKnowsCrossings;
    // The lattice edges on the upper faces of a brick belong to the bricks above.
    for (const std::size_t slot : kNeighboursAbove) {
      const std::uint32_t above = neighbours[kNeighbours * b + slot];
      if (above != ~0u) kinds[above] |= kKnowsCrossings;
    }
  }
  return kinds;
}

}  // namespace isofield::engine
