// What operators that take all their operands at once share.
#pragma once

#include <cstdint>
#include <vector>

#include "base/field_reader.h"
#include "operators/bulge_elimination.h"
#include "operators/kind.h"
#include "operators/terms.h"

namespace isofield::operators {

// The value of an operator with its partial derivatives by each operand.
template <class T>
struct Joint {
  T g;
  std::vector<T> partials;
};

// The operands that pruning has left, a bit each, of those that the operator had.
struct OperandMask {
  std::uint32_t bits, operands;
  bool has(std::uint32_t operand) const { return (bits >> operand & 1) != 0; }
};

// As many operands as terms, or any number where there is one term for all; two where ranges follow an angle.
OperandCount joint_operand_count(std::size_t terms, const BulgeElimination& by_angle);

// One term for each operand, or one for all. A list holds one number for each operand, one for all, or none where it
// has a default, which ranges have not.
std::vector<Term> read_terms(const base::FieldReader::Numbers& ranges, const base::FieldReader::Numbers& powers,
                             const base::FieldReader::Numbers& weights, base::FieldReader& in);

}  // namespace isofield::operators
